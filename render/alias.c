#include "alias.h"

#include <stdlib.h>

static void pair_up(alias_table *table, double *scaled, uint32_t *stack) {
    uint32_t small = 0, large = table->count;
    for (uint32_t i = 0; i < table->count; i++) {
        if (scaled[i] < 1.0)
            stack[small++] = i;
        else
            stack[--large] = i;
    }
    while (small > 0 && large < table->count) {
        uint32_t poor = stack[--small];
        uint32_t rich = stack[large];
        table->cells[poor].keep = (float)scaled[poor];
        table->cells[poor].other = rich;
        scaled[rich] -= 1.0 - scaled[poor];
        if (scaled[rich] < 1.0) {
            large++;
            stack[small++] = rich;
        }
    }
}

int lobe_alias_create(alias_table *table, const double *weights, uint32_t count) {
    *table = (alias_table){NULL, NULL, count};
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) sum += weights[i];
    if (!(sum > 0.0)) return 1;
    double *scaled = malloc(count * sizeof *scaled);
    uint32_t *stack = malloc(count * sizeof *stack);
    table->cells = malloc(count * sizeof *table->cells);
    table->shares = malloc(count * sizeof *table->shares);
    int ok = scaled && stack && table->cells && table->shares;
    if (ok) {
        for (uint32_t i = 0; i < count; i++) {
            scaled[i] = weights[i] / sum * count;
            table->cells[i] = (alias_cell){1.0f, i};
            table->shares[i] = (float)(weights[i] / sum);
        }
        pair_up(table, scaled, stack);
    } else {
        lobe_alias_free(table);
    }
    free(scaled);
    free(stack);
    return ok;
}

void lobe_alias_free(alias_table *table) {
    free(table->cells);
    free(table->shares);
    table->cells = NULL;
    table->shares = NULL;
}
