/* tests/lib/dielectric_batch_template.h: batches of dielectrics against single calls, once for each precision.
 * Before including:
 *   REAL        float or double
 *   NAME(stem)  stem_f32 or stem_f64 */

#define MODEL NAME(lobe_dielectric)
#define IN(data) ((NAME(lobe_in)){data, 1})
#define OUT(data) ((NAME(lobe_out)){data, 1})

typedef struct NAME(rows) {
    REAL wi[3][COUNT], alpha[2][COUNT], ior[COUNT], u[3][COUNT], to[3][COUNT];
    REAL m[3][COUNT], wo[3][COUNT], cos_im[COUNT], fresnel[COUNT], pdf_m[COUNT], pdf[COUNT];
    REAL weight[COUNT], is_point[COUNT], f_cos[COUNT];
} NAME(rows);

/* Indices on both sides of 1, one in twelve equal to it; smooth and rough; one number in sixteen is special. */
static void NAME(fill)(NAME(rows) * r) {
    static const double odd[] = {0, -0.0, 1, 1e-4, 9e-5, 2e4, -1, INFINITY, NAN, 1e-30, 1e3, 0.5};
    for (int i = 0; i < COUNT; ++i) {
        double u[10];
        for (int k = 0; k < 5; ++k)
            case_random(77 + (uint64_t)k, (uint64_t)i, &u[2 * k], &u[2 * k + 1]);
        const lobe_vec3_f64 wi = case_direction(180 * u[0], 360 * u[1]);
        const lobe_vec3_f64 to = case_direction(180 * u[2], 360 * u[3]);
        const double wis[3] = {wi.x, wi.y, wi.z}, tos[3] = {to.x, to.y, to.z};
        for (int k = 0; k < 3; ++k) {
            r->wi[k][i] = (REAL)wis[k];
            r->to[k][i] = (REAL)tos[k];
            r->u[k][i] = (REAL)u[4 + k];
        }
        r->alpha[0][i] = r->alpha[1][i] = (REAL)pow(10, 3 * u[7] - 3);
        if (i % 3 == 0) r->alpha[1][i] = (REAL)0.3;
        if (i % 11 == 0) r->alpha[0][i] = r->alpha[1][i] = 0;
        r->ior[i] = i % 12 == 0 ? 1 : (REAL)pow(2.5, 2 * u[8] - 1);
        const int which = (int)(u[9] * 16 * 12);
        const REAL special = (REAL)odd[i % 12];
        if (which < 3) r->wi[which][i] = special;
        if (which >= 3 && which < 6) r->to[which - 3][i] = special;
        if (which >= 6 && which < 9) r->u[which - 6][i] = special;
        if (which >= 9 && which < 11) r->alpha[which - 9][i] = special;
        if (which == 11) r->ior[i] = special;
    }
}

static int NAME(same)(REAL a, REAL b) {
    return memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b);
}

#define SAME(member, expected)                                                                     \
    if (!NAME(same)(r->member, expected))                                                          \
    fail_msg("%s row %d: " #member " %.9g, alone %.9g", lobe_isa(), i, (double)(r->member),        \
             (double)(expected))

static void NAME(check)(const NAME(rows) * r, const MODEL *shared,
                        lobe_dielectric_options options) {
    for (int i = 0; i < COUNT; ++i) {
        const NAME(lobe_vec3) wi = {r->wi[0][i], r->wi[1][i], r->wi[2][i]};
        const NAME(lobe_vec3) to = {r->to[0][i], r->to[1][i], r->to[2][i]};
        const MODEL model = shared ? *shared
                                   : NAME(lobe_dielectric_prepare)(options, wi, r->alpha[0][i],
                                                                   r->alpha[1][i], r->ior[i]);
        const NAME(lobe_dielectric_draw) d =
            NAME(lobe_dielectric_sample)(&model, r->u[0][i], r->u[1][i], r->u[2][i]);
        SAME(m[0][i], d.m.x);
        SAME(m[1][i], d.m.y);
        SAME(m[2][i], d.m.z);
        SAME(wo[0][i], d.wo.x);
        SAME(wo[1][i], d.wo.y);
        SAME(wo[2][i], d.wo.z);
        SAME(pdf_m[i], d.pdf_m);
        SAME(weight[i], d.weight);
        SAME(is_point[i], (REAL)d.is_point);
        const NAME(lobe_dielectric_eval) e = NAME(lobe_dielectric_eval_wo)(&model, to);
        SAME(pdf[i], e.pdf);
        SAME(f_cos[i], e.f_cos);
        SAME(fresnel[i], e.fresnel);
        SAME(cos_im[i], e.cos_im);
    }
}

/* Draws, then densities, whose cos_im, fresnel and pdf take the place of those of the draws. */
static void NAME(run)(NAME(rows) * r, const MODEL *shared, lobe_dielectric_options options) {
    NAME(lobe_dielectric_sample_batch)
    s = {.count = COUNT, .prepared = shared, .options = options};
    NAME(lobe_dielectric_eval_batch)
    e = {.count = COUNT, .prepared = shared, .options = options};
    for (int k = 0; k < 3; ++k) {
        s.wi[k] = e.wi[k] = IN(r->wi[k]);
        s.u[k] = IN(r->u[k]);
        e.wo[k] = IN(r->to[k]);
        s.m[k] = OUT(r->m[k]);
        s.wo[k] = OUT(r->wo[k]);
    }
    for (int k = 0; k < 2; ++k) s.alpha[k] = e.alpha[k] = IN(r->alpha[k]);
    s.ior = e.ior = IN(r->ior);
    s.pdf_m = OUT(r->pdf_m);
    s.weight = OUT(r->weight);
    s.is_point = OUT(r->is_point);
    e.pdf = OUT(r->pdf);
    e.f_cos = OUT(r->f_cos);
    e.fresnel = OUT(r->fresnel);
    e.cos_im = OUT(r->cos_im);
    NAME(lobe_dielectric_sample_many)(&s);
    NAME(lobe_dielectric_eval_many)(&e);
}

static void NAME(every_choice)(void) {
    NAME(rows) *r = malloc(sizeof *r);
    assert_non_null(r);
    NAME(fill)(r);
    const NAME(lobe_vec3) wi = {(REAL)0.6, 0, (REAL)-0.8};
    for (int set = 0; lobe_isa_at(set); ++set) {
        assert_true(lobe_restrict_isa(lobe_isa_at(set)));
        for (int choice = 0; choice < 16; ++choice) {
            const lobe_dielectric_options options = {
                choice & 1 ? LOBE_G2_SEPARABLE : LOBE_G2_CORRELATED,
                choice & 2 ? LOBE_TRANSPORT_IMPORTANCE : LOBE_TRANSPORT_RADIANCE, choice >> 2 & 1,
                choice >> 3 & 1};
            const MODEL glass =
                NAME(lobe_dielectric_prepare)(options, wi, (REAL)0.2, (REAL)0.4, (REAL)1.5);
            NAME(run)(r, NULL, options);
            NAME(check)(r, NULL, options);
            NAME(run)(r, &glass, options);
            NAME(check)(r, &glass, options);
        }
    }
    lobe_restrict_isa(NULL);
    free(r);
}

/* The built-in random numbers, and interleaved outputs. */
static void NAME(strides_and_numbers)(void) {
    REAL rows[4 * COUNT];
    const NAME(lobe_vec3) wi = {(REAL)0.6, 0, (REAL)0.8};
    const MODEL glass = NAME(lobe_dielectric_prepare)(lobe_dielectric_default_options(), wi,
                                                      (REAL)0.3, (REAL)0.3, (REAL)1.5);
    NAME(lobe_dielectric_sample_batch)
    s = {.count = COUNT, .prepared = &glass, .seed = 5, .offset = 9};
    for (int k = 0; k < 3; ++k) s.wo[k] = (NAME(lobe_out)){rows + k, 4};
    s.pdf = (NAME(lobe_out)){rows + 3, 4};
    NAME(lobe_dielectric_sample_many)(&s);
    for (int i = 0; i < COUNT; ++i) {
        REAL u[3];
        NAME(lobe_draw_numbers)(5, 9 + (uint64_t)i, u);
        const NAME(lobe_dielectric_draw) d = NAME(lobe_dielectric_sample)(&glass, u[0], u[1], u[2]);
        assert_true(NAME(same)(rows[4 * i], d.wo.x));
        assert_true(NAME(same)(rows[4 * i + 2], d.wo.z));
        assert_true(NAME(same)(rows[4 * i + 3], d.pdf));
    }
}

#undef SAME
#undef IN
#undef OUT
#undef MODEL
#undef REAL
#undef NAME
