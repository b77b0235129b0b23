/* lib/batch_views.h: from the arrays of a caller to whole vectors and back. Before including: BATCH_NAME and the
 * binding of a precision. */
#include "lobe/batch.h"
#include "lobe/random.h"

#include "batch_rows.h"

typedef BATCH_NAME(lobe_in) input;
typedef BATCH_NAME(lobe_out) output;

/* Rows that the loops can work on where they are. */
static bool is_direct(ptrdiff_t stride, int n) {
    return stride == 1 && n == whole_vectors(n);
}

/* The rows of an input; a copy goes on with its last row up to whole vectors. */
static const real *gather(input in, size_t first, int n, real *to) {
    const real *from = in.data + (ptrdiff_t)first * in.stride;
    if (is_direct(in.stride, n)) return from;
    for (int i = 0; i < n; ++i) to[i] = from[i * in.stride];
    for (int i = n; i < whole_vectors(n); ++i) to[i] = to[n - 1];
    return to;
}

/* Where the loops write the rows of an output. */
static real *place_of(output out, size_t first, int n, real *instead) {
    return out.data != NULL && is_direct(out.stride, n) ? out.data + first : instead;
}

static void scatter(output out, size_t first, int n, const real *from) {
    if (out.data == NULL || is_direct(out.stride, n)) return;
    real *to = out.data + (ptrdiff_t)first * out.stride;
    for (int i = 0; i < n; ++i) to[i * out.stride] = from[i];
}

/* The random numbers that a caller gives, or those of (seed, offset) into `to`. */
static void gather_numbers(const input u[3], uint64_t seed, uint64_t offset, size_t first, int n,
                           const real *rows[3], real (*to)[BLOCK]) {
    const bool are_given = u[0].data != NULL;
    for (int i = 0; !are_given && i < whole_vectors(n); ++i) {
        real drawn[3];
        BATCH_NAME(lobe_draw_numbers)(seed, offset + first + (uint64_t)i, drawn);
        for (int k = 0; k < 3; ++k) to[k][i] = drawn[k];
    }
    for (int k = 0; k < 3; ++k) {
        rows[k] = to[k];
        if (u[k].data != NULL)
            rows[k] = gather(u[k], first, n, to[k]);
        else if (are_given)
            memset(to[k], 0, sizeof to[k]);
    }
}

static int rows_at(size_t count, size_t first) {
    return count - first < BLOCK ? (int)(count - first) : BLOCK;
}
