/* app/merge.c: `lobe merge`: join renders of several seeds or parts. */
#include <math.h>
#include <string.h>
#include <strings.h>

#include <lobe/render.h>

#include "commands.h"
#include "json.h"
#include "options.h"
#include "output.h"

typedef struct merge_values {
    const char *out;
    double exposure;
    bool json;
} merge_values;

#define AT(member) offsetof(merge_values, member)

static const lobe_app_option options[] = {
    {"-o", "FILE", NULL, "the picture: .exr, .png, .hdr or .pfm; or FILE.checkpoint to go on with",
     lobe_app_read_name, AT(out), NULL},
    {"--exposure", "EV", "0", "stops, for the written picture", lobe_app_read_f64, AT(exposure),
     NULL},
    {"--json", NULL, NULL, "what was joined as JSON on standard output", NULL, AT(json), NULL},
    {0}};

static bool is_checkpoint(const char *path) {
    static const char ending[] = ".checkpoint";
    const size_t length = strlen(path), tail = sizeof ending - 1;
    return length >= tail && strcasecmp(path + length - tail, ending) == 0;
}

static lobe_app_status check(const merge_values *v, const lobe_app_arguments *arguments) {
    if (!arguments->operand)
        return lobe_app_reject("merge", "give .exr files or checkpoints of lobe render",
                               "nothing to join");
    if (!v->out)
        return lobe_app_reject("-o", "give a file name, as -o picture.exr", "no picture to write");
    if (!is_checkpoint(v->out) && !lobe_film_can_write(v->out))
        return lobe_app_reject(v->out, "end the name with .exr, .png, .hdr, .pfm or .checkpoint",
                               "unknown format");
    if (!(fabs(v->exposure) <= 100))
        return lobe_app_reject("--exposure", "use -100 to 100", "out of range");
    return LOBE_APP_DONE;
}

static lobe_render_result write_film(const merge_values *v, const lobe_film *film) {
    if (is_checkpoint(v->out)) return lobe_film_save(film, v->out);
    lobe_film_write_options write = lobe_film_default_write_options();
    write.exposure = (float)v->exposure;
    return lobe_film_write(film, v->out, write);
}

static lobe_app_status print_json(const lobe_film *film, int count) {
    const lobe_film_samples samples = lobe_film_get_samples(film);
    return lobe_app_print_json(
        json_pack("{si si si sI sI sI}", "files", count, "width", lobe_film_width(film), "height",
                  lobe_film_height(film), "seeds", (json_int_t)samples.seeds, "fewest_samples",
                  (json_int_t)samples.fewest, "most_samples", (json_int_t)samples.most));
}

static lobe_app_status merge(const merge_values *v, const lobe_app_arguments *arguments) {
    lobe_film *film = NULL;
    lobe_render_result result = lobe_film_merge((const char *const *)arguments->operands,
                                                (size_t)arguments->operand_count, &film);
    if (result == LOBE_RENDER_OK) result = write_film(v, film);
    lobe_app_status status = LOBE_APP_DONE;
    if (result != LOBE_RENDER_OK) {
        lobe_app_report_line(lobe_render_error_message());
        status = result == LOBE_RENDER_BAD_INPUT ? LOBE_APP_BAD_INPUT : LOBE_APP_FAILED;
    } else if (v->json) {
        status = print_json(film, arguments->operand_count);
    }
    lobe_film_free(film);
    return status;
}

lobe_app_status lobe_app_merge(int argc, char **argv) {
    merge_values values = {0};
    const lobe_app_group groups[] = {{"Output", options, &values}, {0}};
    const lobe_app_command command = {
        .name = "merge",
        .usage = "FILE... -o FILE [OPTIONS]",
        .about = "Joins renders of one scene with the same options: .exr files or checkpoints. "
                 "Different seeds are\n"
                 "averaged by their numbers of samples; all parts of one seed (lobe render --part) "
                 "give the bits of\n"
                 "the whole render.",
        .operand = "FILE...",
        .groups = groups,
        .example = "lobe merge part1.exr part2.exr -o picture.exr"};
    lobe_app_arguments arguments;
    lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;
    status = check(&values, &arguments);
    return status ? status : merge(&values, &arguments);
}
