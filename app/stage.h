/* app/stage.h: two pictures on one place of a page, with a slider between them and buttons that choose.
 *
 * Every picture is on the page once, as an <img class=pick id=i-M-N-K>: contender M, size or frame N, kind K (p:
 * picture, r: relative error, f: FLIP); its `alt` is the caption. The reference is i-ref-N, or i-ref for all N. */
#ifndef LOBE_APP_STAGE_H
#define LOBE_APP_STAGE_H

#include <stdbool.h>
#include <stdio.h>

/* The head of a page that has a stage and charts. */
void lobe_app_begin_stage_html(FILE *file, const char *title);

/* Chooses `value` of M, N or K, `what` being m, n or k. The text and </button> are the caller's. */
void lobe_app_begin_stage_button(FILE *file, char what, const char *value, bool is_on);

/* At first N = n and M = 0. `reference`: what is on the left, plain text. */
void lobe_app_write_stage(FILE *file, int n, int width, int height, const char *reference);

/* At the end of the page. */
void lobe_app_write_stage_script(FILE *file);

#endif
