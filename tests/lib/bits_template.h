/* tests/lib/bits_template.h: the hash of one model's batches, once for each precision. Before including:
 *   REAL        float or double
 *   NAME(stem)  stem_f32 or stem_f64
 *   WORD        the unsigned integer of its width */

/* Any NaN is any other: which one an operation gives is the processor's affair. */
static uint64_t NAME(mix_all)(uint64_t hash, const REAL *values, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        WORD word = (WORD)-1;
        if (values[i] == values[i]) memcpy(&word, &values[i], sizeof word);
        hash = mixed(hash, word);
    }
    return hash;
}

static uint64_t NAME(hash_block)(uint64_t hash, lobe_reflection_options options,
                                 REAL in[INPUTS][BLOCK], size_t count) {
    static REAL out[18][BLOCK];
    NAME(lobe_sample_batch) s;
    NAME(lobe_eval_batch) e;
    memset(&s, 0, sizeof s);
    memset(&e, 0, sizeof e);
    s.count = e.count = count;
    s.options = e.options = options;
    for (int k = 0; k < 3; ++k) {
        s.wi[k] = e.wi[k] = (NAME(lobe_in)){in[k], 1};
        e.wo[k] = (NAME(lobe_in)){in[3 + k], 1};
        s.u[k] = (NAME(lobe_in)){in[8 + k], 1};
        s.m[k] = (NAME(lobe_out)){out[k], 1};
        s.wo[k] = (NAME(lobe_out)){out[3 + k], 1};
    }
    for (int k = 0; k < 2; ++k) s.alpha[k] = e.alpha[k] = (NAME(lobe_in)){in[6 + k], 1};
    s.cos_im = (NAME(lobe_out)){out[6], 1};
    s.pdf_m = (NAME(lobe_out)){out[7], 1};
    s.pdf = (NAME(lobe_out)){out[8], 1};
    s.weight = (NAME(lobe_out)){out[9], 1};
    e.pdf = (NAME(lobe_out)){out[10], 1};
    e.f_cos = (NAME(lobe_out)){out[11], 1};
    e.cos_im = (NAME(lobe_out)){out[12], 1};
    NAME(lobe_reflection_sample_batch)(&s);
    NAME(lobe_reflection_eval_batch)(&e);
    for (int k = 0; k < 3; ++k) { /* normals alone */
        s.m[k].data = out[13 + k];
        s.wo[k].data = NULL;
    }
    s.cos_im.data = out[16];
    s.pdf_m.data = out[17];
    s.pdf.data = s.weight.data = NULL;
    NAME(lobe_reflection_sample_batch)(&s);
    for (int k = 0; k < 18; ++k) hash = NAME(mix_all)(hash, out[k], count);
    return hash;
}

static uint64_t NAME(hash_of)(lobe_reflection_options options, uint64_t rows) {
    static REAL in[INPUTS][BLOCK];
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (uint64_t first = 0; first < rows; first += BLOCK) {
        const size_t count = rows - first < BLOCK ? (size_t)(rows - first) : BLOCK;
        for (size_t i = 0; i < count; ++i) {
            double row[INPUTS];
            random_row(first + i, row);
            for (int k = 0; k < INPUTS; ++k) in[k][i] = (REAL)row[k];
        }
        hash = NAME(hash_block)(hash, options, in, count);
    }
    return hash;
}

#undef REAL
#undef NAME
#undef WORD
