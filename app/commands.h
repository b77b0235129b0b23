/* app/commands.h: one function a command, each in the file of its name. `argv[0]` is the first
 * argument after the command's name. */
#ifndef LOBE_APP_COMMANDS_H
#define LOBE_APP_COMMANDS_H

#include "report.h"

typedef lobe_app_status lobe_app_run(int argc, char **argv);

lobe_app_run lobe_app_sample, lobe_app_eval, lobe_app_albedo, lobe_app_verify, lobe_app_bench,
    lobe_app_render, lobe_app_compare, lobe_app_merge, lobe_app_figure, lobe_app_explore,
    lobe_app_ssr, lobe_app_info;

/* `lobe bench render` */
lobe_app_run lobe_app_bench_render;

#endif
