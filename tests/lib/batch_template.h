/* tests/lib/batch_template.h: the tests of the batches, once for each precision. Before including:
 *   REAL        float or double
 *   NAME(stem)  stem_f32 or stem_f64
 *   WORD        the unsigned integer of its width */

#define ROWS NAME(rows)
#define SAMPLE_BATCH NAME(lobe_sample_batch)
#define EVAL_BATCH NAME(lobe_eval_batch)
#define MODEL NAME(lobe_reflection)

/* An adversarial table of inputs. */
enum { NAME(COUNT) = 3001 };
typedef struct ROWS {
    REAL wi[3][NAME(COUNT)], alpha[2][NAME(COUNT)], u[3][NAME(COUNT)], wo[3][NAME(COUNT)];
} ROWS;

/* What a batch writes, all of it. */
typedef struct NAME(results) {
    REAL m[3][NAME(COUNT)], wo[3][NAME(COUNT)], cos_im[NAME(COUNT)];
    REAL pdf_m[NAME(COUNT)], pdf[NAME(COUNT)], weight[NAME(COUNT)], f_cos[NAME(COUNT)];
} NAME(results);

static REAL NAME(odd_number)(uint32_t word) {
    static const double odd[] = {0,    -0.0, 1,        0.5,       1e-4, 9.9e-5, 1e4,  2e4,
                                 1e-8, -1,   INFINITY, -INFINITY, NAN,  1e-30,  1e30, 0.99999994};
    return (REAL)odd[word % (sizeof odd / sizeof *odd)];
}

static ROWS *NAME(make_rows)(void) {
    ROWS *r = malloc(sizeof *r);
    assert_non_null(r);
    for (int i = 0; i < NAME(COUNT); ++i) {
        lobe_random4 a = lobe_random(5, 0, (uint64_t)i), b = lobe_random(5, 1, (uint64_t)i),
                     c = lobe_random(5, 2, (uint64_t)i);
        double angle = 3.1 * lobe_random_unit_f32(a.word[0]),
               turn = lobe_random_unit_f32(a.word[1]);
        lobe_vec3_f64 wi = case_direction(57.3 * angle, 360 * turn);
        lobe_vec3_f64 wo = case_direction(100 * lobe_random_unit_f32(b.word[0]),
                                          360 * lobe_random_unit_f32(b.word[1]));
        const double wis[3] = {wi.x, wi.y, wi.z}, wos[3] = {wo.x, wo.y, wo.z};
        for (int k = 0; k < 3; ++k) {
            r->wi[k][i] = (REAL)wis[k];
            r->wo[k][i] = (REAL)wos[k];
            r->u[k][i] = (REAL)lobe_random_unit_f32(c.word[k]);
        }
        for (int k = 0; k < 2; ++k)
            r->alpha[k][i] = (REAL)pow(10, 3.5 * lobe_random_unit_f32(a.word[2 + k]) - 3);
        /* one input in eight is out of the ordinary */
        uint32_t which = b.word[2] % 88;
        REAL odd = NAME(odd_number)(b.word[3]);
        if (which < 3) r->wi[which][i] = odd;
        if (which >= 3 && which < 6) r->wo[which - 3][i] = odd;
        if (which >= 6 && which < 9) r->u[which - 6][i] = odd;
        if (which >= 9 && which < 11) r->alpha[which - 9][i] = odd;
    }
    return r;
}

static void NAME(want_sample)(SAMPLE_BATCH *b, NAME(results) * out) {
    for (int k = 0; k < 3; ++k) {
        b->m[k] = (NAME(lobe_out)){out->m[k], 1};
        b->wo[k] = (NAME(lobe_out)){out->wo[k], 1};
    }
    b->cos_im = (NAME(lobe_out)){out->cos_im, 1};
    b->pdf_m = (NAME(lobe_out)){out->pdf_m, 1};
    b->pdf = (NAME(lobe_out)){out->pdf, 1};
    b->weight = (NAME(lobe_out)){out->weight, 1};
}

static SAMPLE_BATCH NAME(sample_of)(const ROWS *r, size_t count, lobe_reflection_options options,
                                    NAME(results) * out) {
    SAMPLE_BATCH b;
    memset(&b, 0, sizeof b);
    b.count = count;
    b.options = options;
    for (int k = 0; k < 3; ++k) {
        b.wi[k] = (NAME(lobe_in)){r->wi[k], 1};
        b.u[k] = (NAME(lobe_in)){r->u[k], 1};
    }
    for (int k = 0; k < 2; ++k) b.alpha[k] = (NAME(lobe_in)){r->alpha[k], 1};
    NAME(want_sample)(&b, out);
    return b;
}

static EVAL_BATCH NAME(eval_of)(const ROWS *r, size_t count, lobe_reflection_options options,
                                NAME(results) * out) {
    EVAL_BATCH b;
    memset(&b, 0, sizeof b);
    b.count = count;
    b.options = options;
    for (int k = 0; k < 3; ++k) {
        b.wi[k] = (NAME(lobe_in)){r->wi[k], 1};
        b.wo[k] = (NAME(lobe_in)){r->wo[k], 1};
    }
    for (int k = 0; k < 2; ++k) b.alpha[k] = (NAME(lobe_in)){r->alpha[k], 1};
    b.pdf = (NAME(lobe_out)){out->pdf, 1};
    b.f_cos = (NAME(lobe_out)){out->f_cos, 1};
    b.cos_im = (NAME(lobe_out)){out->cos_im, 1};
    return b;
}

/* Bits, but any NaN for any other: which NaN an operation gives is the processor's affair. */
static int NAME(same)(REAL a, REAL b) {
    WORD x, y;
    memcpy(&x, &a, sizeof a);
    memcpy(&y, &b, sizeof b);
    return x == y || (a != a && b != b);
}

#define CHECK(member, expected)                                                                    \
    if (!NAME(same)(out->member, expected))                                                        \
    fail_msg("%s %s row %d: " #member " %.9g, alone %.9g", lobe_isa(), name, i,                    \
             (double)(out->member), (double)(expected))

static MODEL NAME(model_at)(const ROWS *r, int i, lobe_reflection_options options) {
    NAME(lobe_vec3) wi = {r->wi[0][i], r->wi[1][i], r->wi[2][i]};
    return NAME(lobe_reflection_prepare)(options, wi, r->alpha[0][i], r->alpha[1][i]);
}

static void NAME(check_samples)(const ROWS *r, const MODEL *shared, lobe_reflection_options options,
                                const NAME(results) * out, const char *name) {
    for (int i = 0; i < NAME(COUNT); ++i) {
        MODEL model = shared ? *shared : NAME(model_at)(r, i, options);
        NAME(lobe_reflection_draw)
        d = NAME(lobe_reflection_sample)(&model, r->u[0][i], r->u[1][i], r->u[2][i]);
        CHECK(m[0][i], d.m.x);
        CHECK(m[1][i], d.m.y);
        CHECK(m[2][i], d.m.z);
        CHECK(wo[0][i], d.wo.x);
        CHECK(wo[1][i], d.wo.y);
        CHECK(wo[2][i], d.wo.z);
        CHECK(cos_im[i], d.cos_im);
        CHECK(pdf_m[i], d.pdf_m);
        CHECK(pdf[i], d.pdf);
        CHECK(weight[i], d.weight);
    }
}

/* Normals alone, from loops of their own: the same. */
static void NAME(check_normals)(SAMPLE_BATCH s, const NAME(results) * all, const char *name) {
    NAME(results) *out = malloc(sizeof *out);
    assert_non_null(out);
    memset(out, 0, sizeof *out);
    NAME(want_sample)(&s, out);
    for (int k = 0; k < 3; ++k) s.wo[k].data = NULL;
    s.pdf.data = s.weight.data = NULL;
    NAME(lobe_reflection_sample_batch)(&s);
    for (int i = 0; i < NAME(COUNT); ++i) {
        for (int k = 0; k < 3; ++k) CHECK(m[k][i], all->m[k][i]);
        CHECK(cos_im[i], all->cos_im[i]);
        CHECK(pdf_m[i], all->pdf_m[i]);
        assert_true(out->wo[0][i] == 0 && out->pdf[i] == 0 && out->weight[i] == 0);
    }
    free(out);
}

static void NAME(check_evals)(const ROWS *r, const MODEL *shared, lobe_reflection_options options,
                              const NAME(results) * out, const char *name) {
    for (int i = 0; i < NAME(COUNT); ++i) {
        MODEL model = shared ? *shared : NAME(model_at)(r, i, options);
        NAME(lobe_vec3) wo = {r->wo[0][i], r->wo[1][i], r->wo[2][i]};
        NAME(lobe_reflection_eval) e = NAME(lobe_reflection_eval_wo)(&model, wo);
        CHECK(pdf[i], e.pdf);
        CHECK(f_cos[i], e.f_cos);
        CHECK(cos_im[i], e.cos_im);
        assert_true(NAME(same)(e.pdf, NAME(lobe_reflection_pdf)(&model, wo)));
    }
}

static void NAME(check_model)(const ROWS *r, lobe_reflection_options options, const char *name) {
    NAME(results) *out = malloc(sizeof *out);
    assert_non_null(out);
    const MODEL shared = NAME(model_at)(r, 5, options);
    for (int k = 0; lobe_isa_at(k); ++k) {
        assert_true(lobe_restrict_isa(lobe_isa_at(k)));
        SAMPLE_BATCH s = NAME(sample_of)(r, NAME(COUNT), options, out);
        NAME(lobe_reflection_sample_batch)(&s);
        NAME(check_samples)(r, NULL, options, out, name);
        NAME(check_normals)(s, out, name);
        s.prepared = &shared;
        NAME(lobe_reflection_sample_batch)(&s);
        NAME(check_samples)(r, &shared, options, out, name);
        NAME(check_normals)(s, out, name);
        EVAL_BATCH e = NAME(eval_of)(r, NAME(COUNT), options, out);
        NAME(lobe_reflection_eval_batch)(&e);
        NAME(check_evals)(r, NULL, options, out, name);
        e.prepared = &shared;
        NAME(lobe_reflection_eval_batch)(&e);
        NAME(check_evals)(r, &shared, options, out, name);
    }
    lobe_restrict_isa(NULL);
    free(out);
}

static void NAME(every_model)(void) {
    ROWS *r = NAME(make_rows)();
    for (int m = 0; m < lobe_model_count(); ++m) {
        lobe_reflection_options options = lobe_reflection_default_options();
        options.model = lobe_model_at(m);
        for (int choice = 0; choice < 3; ++choice) {
            options.g2 = choice == 1 ? LOBE_G2_SEPARABLE : LOBE_G2_CORRELATED;
            options.normalization =
                choice == 2 ? LOBE_NORMALIZATION_PREVIOUS : LOBE_NORMALIZATION_UNBIASED;
            NAME(check_model)(r, options, lobe_method_name(options.model.method));
        }
    }
    lobe_reflection_options unknown = lobe_reflection_default_options();
    unknown.model.method = LOBE_METHOD_COUNT;
    NAME(check_model)(r, unknown, "a model that does not exist");
    free(r);
}

/* Lengths around every width, the block's too, from every alignment: the same as in one long batch. */
static void NAME(lengths)(void) {
    ROWS *r = NAME(make_rows)();
    NAME(results) *all = malloc(sizeof *all), *out = malloc(sizeof *out);
    assert_true(all != NULL && out != NULL);
    const lobe_reflection_options options = lobe_reflection_default_options();
    SAMPLE_BATCH whole = NAME(sample_of)(r, NAME(COUNT), options, all);
    NAME(lobe_reflection_sample_batch)(&whole);
    for (int k = 0; lobe_isa_at(k); ++k) {
        assert_true(lobe_restrict_isa(lobe_isa_at(k)));
        for (int length = 0; length < 300; length += length < 40 ? 1 : 11) {
            for (int offset = 0; offset < 5; ++offset) {
                SAMPLE_BATCH s = NAME(sample_of)(r, (size_t)length, options, out);
                for (int c = 0; c < 3; ++c) s.wi[c].data += offset, s.u[c].data += offset;
                for (int c = 0; c < 2; ++c) s.alpha[c].data += offset;
                s.pdf.data += offset;
                out->pdf[offset + length] = 12345;
                NAME(lobe_reflection_sample_batch)(&s);
                for (int i = 0; i < length; ++i)
                    assert_true(NAME(same)(out->pdf[offset + i], all->pdf[offset + i]));
                assert_true(out->pdf[offset + length] == 12345);
            }
        }
    }
    lobe_restrict_isa(NULL);
    free(all);
    free(out);
    free(r);
}

/* Interleaved rows, one alpha for all, and wo written over wi. */
static void NAME(strides)(void) {
    ROWS *r = NAME(make_rows)();
    NAME(results) *all = malloc(sizeof *all);
    REAL *mixed = malloc(sizeof(REAL) * 8 * NAME(COUNT));
    assert_true(all != NULL && mixed != NULL);
    const REAL alpha = (REAL)0.3;
    const lobe_reflection_options options = lobe_reflection_default_options();
    SAMPLE_BATCH s = NAME(sample_of)(r, NAME(COUNT), options, all);
    s.alpha[0] = s.alpha[1] = (NAME(lobe_in)){&alpha, 0};
    NAME(lobe_reflection_sample_batch)(&s);
    for (int i = 0; i < NAME(COUNT); ++i)
        for (int k = 0; k < 3; ++k) mixed[8 * i + k] = r->wi[k][i];
    for (int k = 0; k < 3; ++k) {
        s.wi[k] = (NAME(lobe_in)){mixed + k, 8};
        s.wo[k] = (NAME(lobe_out)){mixed + k, 8};
        s.m[k].data = NULL;
    }
    s.pdf = (NAME(lobe_out)){mixed + 3, 8};
    s.weight = s.pdf_m = s.cos_im = (NAME(lobe_out)){NULL, 0};
    NAME(lobe_reflection_sample_batch)(&s);
    for (int i = 0; i < NAME(COUNT); ++i) {
        for (int k = 0; k < 3; ++k) assert_true(NAME(same)(mixed[8 * i + k], all->wo[k][i]));
        assert_true(NAME(same)(mixed[8 * i + 3], all->pdf[i]));
    }
    free(mixed);
    free(all);
    free(r);
}

/* Rows side by side, and every output written over an input. */
static void NAME(in_place)(void) {
    ROWS *r = NAME(make_rows)();
    NAME(results) *all = malloc(sizeof *all);
    assert_true(all != NULL);
    const lobe_reflection_options options = lobe_reflection_default_options();
    SAMPLE_BATCH s = NAME(sample_of)(r, NAME(COUNT), options, all);
    EVAL_BATCH e = NAME(eval_of)(r, NAME(COUNT), options, all);
    for (int k = 0; lobe_isa_at(k); ++k) {
        assert_true(lobe_restrict_isa(lobe_isa_at(k)));
        ROWS *mixed = NAME(make_rows)();
        NAME(lobe_reflection_sample_batch)(&s);
        SAMPLE_BATCH over = NAME(sample_of)(mixed, NAME(COUNT), options, all);
        for (int c = 0; c < 3; ++c) {
            over.wo[c].data = mixed->wi[c];
            over.m[c].data = mixed->u[c];
        }
        over.pdf.data = mixed->alpha[0];
        over.weight.data = mixed->alpha[1];
        over.cos_im = over.pdf_m = (NAME(lobe_out)){NULL, 0};
        NAME(lobe_reflection_sample_batch)(&over);
        for (int i = 0; i < NAME(COUNT); ++i) {
            for (int c = 0; c < 3; ++c) {
                assert_true(NAME(same)(mixed->wi[c][i], all->wo[c][i]));
                assert_true(NAME(same)(mixed->u[c][i], all->m[c][i]));
            }
            assert_true(NAME(same)(mixed->alpha[0][i], all->pdf[i]));
            assert_true(NAME(same)(mixed->alpha[1][i], all->weight[i]));
        }
        free(mixed);
        mixed = NAME(make_rows)();
        NAME(lobe_reflection_eval_batch)(&e);
        EVAL_BATCH eval_over = NAME(eval_of)(mixed, NAME(COUNT), options, all);
        eval_over.pdf.data = mixed->wo[2];
        eval_over.f_cos.data = mixed->wi[0];
        eval_over.cos_im.data = mixed->alpha[0];
        NAME(lobe_reflection_eval_batch)(&eval_over);
        for (int i = 0; i < NAME(COUNT); ++i) {
            assert_true(NAME(same)(mixed->wo[2][i], all->pdf[i]));
            assert_true(NAME(same)(mixed->wi[0][i], all->f_cos[i]));
            assert_true(NAME(same)(mixed->alpha[0][i], all->cos_im[i]));
        }
        free(mixed);
    }
    lobe_restrict_isa(NULL);
    free(all);
    free(r);
}

/* Copies an input to where memory begins or ends, or makes an output lie there. */
static void NAME(fence_in)(NAME(lobe_in) * in, size_t count, fence_side side) {
    REAL *moved = fence_alloc(count * sizeof(REAL), side);
    memcpy(moved, in->data, count * sizeof(REAL));
    in->data = moved;
}

static void NAME(fence_out)(NAME(lobe_out) * out, size_t count, fence_side side) {
    out->data = fence_alloc(count * sizeof(REAL), side);
}

static void NAME(fence_sample)(SAMPLE_BATCH *s, fence_side side) {
    for (int k = 0; k < 3; ++k) {
        NAME(fence_in)(&s->wi[k], s->count, side);
        NAME(fence_in)(&s->u[k], s->count, side);
        NAME(fence_out)(&s->m[k], s->count, side);
        NAME(fence_out)(&s->wo[k], s->count, side);
    }
    for (int k = 0; k < 2; ++k) NAME(fence_in)(&s->alpha[k], s->count, side);
    NAME(fence_out)(&s->cos_im, s->count, side);
    NAME(fence_out)(&s->pdf_m, s->count, side);
    NAME(fence_out)(&s->pdf, s->count, side);
    NAME(fence_out)(&s->weight, s->count, side);
}

static void NAME(fence_eval)(EVAL_BATCH *e, fence_side side) {
    for (int k = 0; k < 3; ++k) {
        NAME(fence_in)(&e->wi[k], e->count, side);
        NAME(fence_in)(&e->wo[k], e->count, side);
    }
    for (int k = 0; k < 2; ++k) NAME(fence_in)(&e->alpha[k], e->count, side);
    NAME(fence_out)(&e->pdf, e->count, side);
    NAME(fence_out)(&e->f_cos, e->count, side);
    NAME(fence_out)(&e->cos_im, e->count, side);
}

/* A batch all of whose arrays lie against a page that may not be touched: an access outside ends the test. */
static void NAME(fenced)(size_t count, fence_side side, const ROWS *r, const NAME(results) * all) {
    NAME(results) *unused = malloc(sizeof *unused);
    assert_non_null(unused);
    const lobe_reflection_options options = lobe_reflection_default_options();
    SAMPLE_BATCH s = NAME(sample_of)(r, count, options, unused);
    EVAL_BATCH e = NAME(eval_of)(r, count, options, unused);
    NAME(fence_sample)(&s, side);
    NAME(fence_eval)(&e, side);
    NAME(lobe_reflection_sample_batch)(&s);
    NAME(lobe_reflection_eval_batch)(&e);
    for (size_t i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) {
            assert_true(NAME(same)(s.wo[k].data[i], all->wo[k][i]));
            assert_true(NAME(same)(s.m[k].data[i], all->m[k][i]));
        }
        assert_true(NAME(same)(s.weight.data[i], all->weight[i]));
        assert_true(NAME(same)(e.f_cos.data[i], all->f_cos[i]));
    }
    free(unused);
    fence_free_all();
}

static void NAME(guarded)(void) {
    static const size_t lengths[] = {1, 7, 15, 16, 17, 33, 77, 127, 128, 129, 300};
    ROWS *r = NAME(make_rows)();
    NAME(results) *all = malloc(sizeof *all);
    assert_non_null(all);
    const lobe_reflection_options options = lobe_reflection_default_options();
    SAMPLE_BATCH s = NAME(sample_of)(r, 300, options, all);
    EVAL_BATCH e = NAME(eval_of)(r, 300, options, all);
    NAME(lobe_reflection_sample_batch)(&s);
    NAME(lobe_reflection_eval_batch)(&e);
    for (int k = 0; lobe_isa_at(k); ++k) {
        assert_true(lobe_restrict_isa(lobe_isa_at(k)));
        for (size_t i = 0; i < sizeof lengths / sizeof *lengths; ++i) {
            NAME(fenced)(lengths[i], FENCE_BEFORE, r, all);
            NAME(fenced)(lengths[i], FENCE_BEHIND, r, all);
        }
    }
    lobe_restrict_isa(NULL);
    free(all);
    free(r);
}

/* The built-in random numbers. */
static void NAME(own_numbers)(void) {
    enum { LENGTH = 77 };
    REAL pdf[LENGTH];
    NAME(lobe_vec3) wi = {(REAL)0.6, 0, (REAL)0.8};
    MODEL model =
        NAME(lobe_reflection_prepare)(lobe_reflection_default_options(), wi, (REAL)0.2, (REAL)0.7);
    for (int k = 0; lobe_isa_at(k); ++k) {
        assert_true(lobe_restrict_isa(lobe_isa_at(k)));
        SAMPLE_BATCH s;
        memset(&s, 0, sizeof s);
        s.count = LENGTH;
        s.prepared = &model;
        s.seed = 3;
        s.offset = 1000;
        s.pdf = (NAME(lobe_out)){pdf, 1};
        NAME(lobe_reflection_sample_batch)(&s);
        for (int i = 0; i < LENGTH; ++i) {
            REAL u[3];
            NAME(lobe_draw_numbers)(3, 1000 + (uint64_t)i, u);
            assert_true(
                NAME(same)(pdf[i], NAME(lobe_reflection_sample)(&model, u[0], u[1], u[2]).pdf));
        }
    }
    lobe_restrict_isa(NULL);
}

#undef CHECK
#undef ROWS
#undef SAMPLE_BATCH
#undef EVAL_BATCH
#undef MODEL
#undef REAL
#undef NAME
#undef WORD
