/* Many rows of a model by the library's batches, a page at a time, once for each precision. Before including:
 *   PAGE, REAL, NAME(stem), NAME(view), and the batches' names:
 *   SAMPLE_BATCH, SAMPLE_MANY, EVAL_BATCH, EVAL_MANY
 *   TAKE_POINTS(batch, array)   asks a batch that knows point masses to mark them in the array */

static void NAME(sample_page)(const lobe_verify_state *state, size_t count, const double *u,
                              lobe_verify_draw *draws) {
    REAL in[3][PAGE], wo[3][PAGE], pdf[PAGE], weight[PAGE], is_point[PAGE] = {0};
    SAMPLE_BATCH batch = {.count = count, .prepared = NAME(view)(state)};
    for (int k = 0; k < 3; ++k) {
        for (size_t i = 0; i < count; ++i) in[k][i] = (REAL)u[3 * i + (size_t)k];
        batch.u[k].data = in[k];
        batch.u[k].stride = 1;
        batch.wo[k].data = wo[k];
        batch.wo[k].stride = 1;
    }
    batch.pdf.data = pdf;
    batch.pdf.stride = 1;
    batch.weight.data = weight;
    batch.weight.stride = 1;
    TAKE_POINTS(batch, is_point);
    SAMPLE_MANY(&batch);
    for (size_t i = 0; i < count; ++i) {
        draws[i] = (lobe_verify_draw){{wo[0][i], wo[1][i], wo[2][i]}, pdf[i], weight[i]};
        if (is_point[i] != 0) draws[i].pdf = draws[i].weight = 0;
    }
}

static void NAME(sample_many)(const lobe_verify_state *state, size_t count, const double *u,
                              lobe_verify_draw *draws) {
    for (size_t done = 0; done < count; done += PAGE) {
        size_t part = count - done < PAGE ? count - done : PAGE;
        NAME(sample_page)(state, part, u + 3 * done, draws + done);
    }
}

static void NAME(evaluate_page)(const lobe_verify_state *state, size_t count, const double *wo,
                                double *density, double *value) {
    REAL in[3][PAGE], pdf[PAGE], f_cos[PAGE];
    EVAL_BATCH batch = {.count = count, .prepared = NAME(view)(state)};
    for (int k = 0; k < 3; ++k) {
        for (size_t i = 0; i < count; ++i) in[k][i] = (REAL)wo[3 * i + (size_t)k];
        batch.wo[k].data = in[k];
        batch.wo[k].stride = 1;
    }
    batch.pdf.data = pdf;
    batch.pdf.stride = 1;
    batch.f_cos.data = f_cos;
    batch.f_cos.stride = 1;
    EVAL_MANY(&batch);
    for (size_t i = 0; i < count; ++i) density[i] = pdf[i];
    for (size_t i = 0; i < count; ++i) value[i] = f_cos[i];
}

static void NAME(evaluate_many)(const lobe_verify_state *state, size_t count, const double *wo,
                                double *density, double *value) {
    for (size_t done = 0; done < count; done += PAGE) {
        size_t part = count - done < PAGE ? count - done : PAGE;
        NAME(evaluate_page)(state, part, wo + 3 * done, density + done, value + done);
    }
}
