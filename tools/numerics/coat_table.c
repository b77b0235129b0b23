/* tools/numerics/coat_table.c: render/coat_table.inc, the albedos of the coat that most scenes have.
 *
 *     cc -O2 -fopenmp -Iinclude -I. tools/numerics/coat_table.c render/coat.c build/liblobe.a -lm -o coat_table
 *     ./coat_table > coat_table.inc && mv coat_table.inc render/          # a second
 */
#include "render/coat.h"

#include <math.h>
#include <stdio.h>

int main(void) {
    static coat_table t = {.ior = COAT_IOR};
    if (!lobe_coat_build(&t, LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, 1)) return 1;
    printf("/* Made by tools/numerics/coat_table.c. */\n{");
    for (int r = 0; r < COAT_ROWS; ++r) {
        printf("{");
        for (int k = 0; k < COAT_RATIOS; ++k) {
            printf("{");
            for (int c = 0; c < COAT_COLUMNS; ++c) {
                printf("{");
                for (int a = 0; a < COAT_AZIMUTHS; ++a)
                    printf("%.0f,", ceil(65535.0 * (double)t.albedo[r][k][c][a]));
                printf("},%s", c % 3 == 2 ? "\n" : "");
            }
            printf("},\n");
        }
        printf("},\n");
    }
    printf("},{");
    for (int r = 0; r < COAT_AVERAGE_ROWS; ++r) {
        printf("{");
        for (int k = 0; k < COAT_AVERAGE_RATIOS; ++k)
            printf("%.7gf,%s", (double)t.average[r][k], k % 8 == 7 ? "\n" : "");
        printf("},\n");
    }
    printf("},\n");
    return 0;
}
