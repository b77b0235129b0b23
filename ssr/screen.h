/* What a screen shows of a linear picture. */
#ifndef LOBE_SSR_SCREEN_H
#define LOBE_SSR_SCREEN_H

/* Three bytes a pixel, sRGB; to be freed. NULL: out of memory. */
unsigned char *lobe_ssr_screen_bytes(int width, int height, const float *rgb, int stride);

#endif
