/* app/eval.c: `lobe eval`: densities and values at given directions. */
#include "commands.h"
#include "interrupt.h"
#include "model.h"
#include "rows.h"
#include "table.h"

typedef enum eval_measure { MEASURE_DIRECTION, MEASURE_NORMAL } eval_measure;

static const char *const measures[] = {"direction", "normal", NULL};
static const char *const formats[] = {"csv", "ndjson", NULL};

typedef struct eval_values {
    lobe_app_model_values model;
    lobe_vec3_f64 wo;
    int measure, format;
    bool json;
} eval_values;

static const lobe_app_option options[] = {
    {"--normalization", "NAME", "unbiased", "of the densities for a wi below the surface",
     lobe_app_read_choice, offsetof(eval_values, model.normalization), lobe_app_normalizations},
    {"--measure", "NAME", "direction",
     "what a row is: a direction ox oy oz, or a microfacet normal "
     "mx my mz",
     lobe_app_read_choice, offsetof(eval_values, measure), measures},
    {"--wo", "X,Y,Z", "rows of standard input", "one direction, instead of rows",
     lobe_app_read_direction, offsetof(eval_values, wo), NULL},
    {"--format", "NAME", "csv", "of the output", lobe_app_read_choice,
     offsetof(eval_values, format), formats},
    {"--json", NULL, NULL, "the same as --format ndjson", NULL, offsetof(eval_values, json), NULL},
    {0}};

static const char *const direction_columns[] = {"ox", "oy",    "oz",    "d",     "g1_i", "g1_o",
                                                "g2", "pdf_m", "pdf_o", "f_cos", NULL};
static const char *const normal_columns[] = {"mx", "my", "mz", "d", "g1_i", "pdf_m", "pdf_o", NULL};

static bool write_direction(const lobe_app_model *model, const lobe_app_table *table,
                            lobe_vec3_f64 wo) {
    const lobe_reflection_eval_f64 e = lobe_app_eval_wo(model, wo);
    const double row[] = {wo.x, wo.y, wo.z, e.d, e.g1_i, e.g1_o, e.g2, e.pdf_m, e.pdf, e.f_cos};
    return lobe_app_write_row(table, row);
}

static bool write_normal(const lobe_app_model *model, const lobe_app_table *table,
                         lobe_vec3_f64 m) {
    const lobe_reflection_eval_f64 e = lobe_app_eval_m(model, m);
    const double row[] = {m.x, m.y, m.z, e.d, e.g1_i, e.pdf_m, e.pdf};
    return lobe_app_write_row(table, row);
}

static lobe_app_status eval_rows(const lobe_app_model *model, const lobe_app_table *table,
                                 eval_measure measure) {
    const bool is_normal = measure == MEASURE_NORMAL;
    lobe_app_rows rows;
    lobe_app_status status =
        lobe_app_open_rows(&rows, "-", is_normal ? "mx my mz" : "ox oy oz", 3, 3);
    while (!status) {
        double v[3];
        int count;
        status = lobe_app_next_row(&rows, v, &count);
        if (status || count == 0) break;
        lobe_vec3_f64 direction = {v[0], v[1], v[2]};
        if (!lobe_app_normalize(model->precision, &direction))
            return lobe_app_reject_row(&rows, "give a vector of any length but 0",
                                       "the vector is zero");
        if (!(is_normal ? write_normal : write_direction)(model, table, direction)) break;
        if (lobe_app_interrupted) status = LOBE_APP_INTERRUPTED;
    }
    return status;
}

static lobe_app_status check(const eval_values *values, const lobe_app_arguments *arguments) {
    if (lobe_app_is_given(arguments, "--wo") && values->measure == MEASURE_NORMAL)
        return lobe_app_reject("--wo", "give the normals as rows on standard input",
                               "contradicts --measure normal");
    if (values->measure == MEASURE_NORMAL && values->model.bsdf == LOBE_APP_DIELECTRIC)
        return lobe_app_reject("--measure", "give directions",
                               "a normal has two directions with --bsdf dielectric");
    return lobe_app_exclude(arguments, "--json", "--format");
}

lobe_app_status lobe_app_eval(int argc, char **argv) {
    eval_values values = {.model = lobe_app_default_model()};
    const lobe_app_group groups[] = {
        {"Model", lobe_app_model_options, &values.model}, {"Evaluation", options, &values}, {0}};
    const lobe_app_command command = {
        "eval",
        "--alpha A[,AY] --wi X,Y,Z [OPTIONS] < ROWS",
        "Evaluates the model at directions o, or at microfacet normals m. Reads rows of three "
        "numbers,\n"
        "of any length, separated by commas or blanks, and writes a row for each, in order: the "
        "vector\n"
        "at unit length, D, G1, G2, the densities over normals and over directions, f(i,o) |o.z|.",
        NULL,
        groups,
        "echo 0,0,1 | lobe eval --alpha 0.3 --wi 0.6,0,0.8"};
    lobe_app_arguments arguments;
    lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;

    lobe_app_model model;
    if ((status = check(&values, &arguments))) return status;
    if ((status = lobe_app_prepare(&values.model, &arguments, &model))) return status;
    const bool is_normal = values.measure == MEASURE_NORMAL;
    const lobe_app_table table = {values.json ? LOBE_APP_NDJSON : (lobe_app_format)values.format,
                                  model.precision, is_normal ? normal_columns : direction_columns};
    lobe_app_catch_interrupt();
    if (!lobe_app_begin_table(&table)) return LOBE_APP_DONE;
    if (!lobe_app_is_given(&arguments, "--wo"))
        return eval_rows(&model, &table, (eval_measure)values.measure);
    write_direction(&model, &table, values.wo);
    return LOBE_APP_DONE;
}
