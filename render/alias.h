/* Alias table (Walker 1977, Vose 1991): draw an index with given weights in constant time. */
#ifndef LOBE_RENDER_ALIAS_H
#define LOBE_RENDER_ALIAS_H

#include <stdint.h>

typedef struct alias_cell {
    float keep;     /* share of the cell that belongs to its own index */
    uint32_t other; /* the index of the rest */
} alias_cell;

typedef struct alias_table {
    alias_cell *cells; /* NULL: all weights are 0, nothing can be drawn */
    float *shares;     /* probability of each index, all together 1; NULL likewise */
    uint32_t count;
} alias_table;

/* Weights: finite, not negative. 0 if memory is short. */
int lobe_alias_create(alias_table *table, const double *weights, uint32_t count);
void lobe_alias_free(alias_table *table);

/* `bits`: 32 random bits: the upper part of their product with the count is the cell, the lower part is for which
 * of its two indices. */
static inline uint32_t alias_draw(const alias_table *table, uint32_t bits) {
    const uint64_t place = (uint64_t)bits * table->count;
    const uint32_t i = (uint32_t)(place >> 32);
    const float rest = (float)((uint32_t)place >> 8) * 0x1p-24f;
    return rest < table->cells[i].keep ? i : table->cells[i].other;
}

/* Where alias_draw will look. */
static inline void alias_prefetch(const alias_table *table, uint32_t bits) {
    __builtin_prefetch(&table->cells[((uint64_t)bits * table->count) >> 32]);
}

#endif
