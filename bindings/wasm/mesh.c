/* What the pictures of a lobe are made of: its surface, and the lines of equal random numbers. */
#include "host.h"
#include "page.h"

typedef lobe_vec3_f32 vec3;

static void ask(int at, vec3 o) {
    page_query[0][at] = o.x;
    page_query[1][at] = o.y;
    page_query[2][at] = o.z;
}

EXPORT(mesh) void page_mesh(int method, int rings, int sectors);
/* Directions that are close together where the lobe is narrow: reflections about normals that are spread evenly
 * over the stretched hemisphere; (rings + 1) x (sectors + 1) of them in page_query, their density and
 * f cos in page_answer, 0 below the surface. */
void page_mesh(int method, int rings, int sectors) {
    const vec3 wi = page_scene[method].wi;
    const float ax = page_model[method].alpha_x, ay = page_model[method].alpha_y;
    for (int j = 0; j <= rings; ++j) {
        const double tilt = 1.5707963267948966 * j / rings;
        const float z = (float)host_cos(tilt), r = (float)host_sin(tilt);
        for (int k = 0; k <= sectors; ++k) {
            const double azimuth = 6.283185307179586 * k / sectors;
            const vec3 m = page_unit(
                (vec3){ax * r * (float)host_cos(azimuth), ay * r * (float)host_sin(azimuth), z});
            ask(j * (sectors + 1) + k, page_reflected(wi, m));
        }
    }
    page_eval_rows(method, (rings + 1) * (sectors + 1));
}

EXPORT(grid) int page_grid(int method, int lines, int steps);
/* Lines of equal u1, then of equal u2, `lines` of each, `steps` + 1 points a line: the directions of the draws
 * in page_query; page_answer[0]: the density, 0 where rejected. Returns the number of points. */
int page_grid(int method, int lines, int steps) {
    int at = 0;
    for (int family = 0; family < 2; ++family)
        for (int line = 0; line < lines; ++line)
            for (int step = 0; step <= steps; ++step) {
                const float across = ((float)line + 0.5f) / (float)lines;
                const float along = page_min((float)step / (float)steps, 0x1.fffffep-1f);
                const lobe_reflection_draw_f32 d =
                    lobe_reflection_sample_f32(&page_model[method], family == 0 ? across : along,
                                               family == 0 ? along : across, 0.5f);
                ask(at, d.wo);
                page_answer[0][at++] = d.pdf;
            }
    return at;
}
