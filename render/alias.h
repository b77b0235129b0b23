/* Alias table (Walker 1977, Vose 1991): draw an index with given weights in constant time. */
#ifndef LOBE_RENDER_ALIAS_H
#define LOBE_RENDER_ALIAS_H

#include <stdint.h>

typedef struct alias_cell {
    float keep;        /* share of the cell that belongs to its own index */
    uint32_t other;    /* the index of the rest */
    float share;       /* probability of the cell's own index, of all indices together 1 */
    float other_share; /* of the other one: a draw reads one cell */
} alias_cell;

typedef struct alias_choice {
    uint32_t index;
    float share; /* its probability */
} alias_choice;

typedef struct alias_table {
    alias_cell *cells; /* NULL: all weights are 0, nothing can be drawn */
    uint32_t count;
} alias_table;

/* Weights: finite, not negative. 0 if memory is short. */
int lobe_alias_create(alias_table *table, const double *weights, uint32_t count);
void lobe_alias_free(alias_table *table);

/* `bits`: 32 random bits for the cell; u in [0, 1) for which of its two indices. */
static inline alias_choice alias_draw(const alias_table *table, uint32_t bits, float u) {
    const uint32_t i = (uint32_t)(((uint64_t)bits * table->count) >> 32);
    const alias_cell *cell = &table->cells[i];
    const int is_own = u < cell->keep;
    return (alias_choice){is_own ? i : cell->other, is_own ? cell->share : cell->other_share};
}

#endif
