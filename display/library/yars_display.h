/* Radar display of a YARS session in the OpenGL context of another program, in C99 and C++. Link yars::display.
 * Inputs: a session; a current context of OpenGL 3.3 core or later; a viewport [pixels]; presses of buttons.
 * Outputs: the picture in the viewport of the bound framebuffer; the presses as input events of the session.
 * Context: it must be current in attach, update, draw, draw_panel and detach. Their changes of OpenGL state are undone.
 * Errors: a function that fails returns -1 or NULL; yars_display_error() says why, in one line.
 * Threads: one at a time for each display. No function waits, except attach. A program may have several displays.
 * Source: docs/attach.md#the-display-in-a-program-of-yours
 *
 *   yars_display* d = yars_display_attach("default", NULL, "my-cockpit");
 *   if (d == NULL) puts(yars_display_error());
 *   each frame:   yars_display_update(d);   ...   yars_display_draw(d, (yars_viewport){620, 100, 600, 600});
 *   yars_display_detach(d);
 */
#ifndef YARS_DISPLAY_H
#define YARS_DISPLAY_H

#include <stddef.h>

#define YARS_DISPLAY_API __attribute__((visibility("default")))

#ifdef __cplusplus
extern "C" {
#endif

typedef struct yars_display yars_display;

/* Rectangle of the bound framebuffer [pixels], from its lower left corner, as in glViewport. */
typedef struct {
  int left, bottom, width, height;
} yars_viewport;

/* What surrounds the picture. Zeros: nothing. */
typedef struct {
  int bezel;          /* 1: the MPD's bezel with its twenty buttons */
  int lit;            /* button that is drawn brighter, 1..20; 0: none */
  int tooltip;        /* button whose tooltip is shown, 1..20; 0: none */
  const char* notice; /* line of text in the upper part of the picture; NULL: none */
} yars_panel;

/* Joins a session, and makes it if it does not exist. NULL: an error.
 * session: NULL is "default".
 * configuration: the GUF file with which the set was started, a path or the name of a file that came with YARS. NULL is
 * the built-in APG-70.
 * program: name of this program in `yars status`; NULL is "host display".
 * Errors: no current context, or OpenGL older than 3.3; an unreadable or invalid configuration; a session of another
 * user or another version. */
YARS_DISPLAY_API yars_display* yars_display_attach(const char* session, const char* configuration, const char* program);

/* Leaves the session and frees the display. NULL is allowed. */
YARS_DISPLAY_API void yars_display_detach(yars_display* d);

/* Reason of this thread's last error, one line; it is overwritten by the next error. "" before the first error. */
YARS_DISPLAY_API const char* yars_display_error(void);

/* Takes what is new in the session. Call it each frame, and at least once a second, even while nothing is drawn.
 * 0: done. */
YARS_DISPLAY_API int yars_display_update(yars_display* d);

/* Draws the picture as the largest square in the middle of the viewport, at most 4096 pixels; the rest of the viewport
 * is unchanged. draw_panel adds the surround. 1: it differs from the last one; 0: it is the same. */
YARS_DISPLAY_API int yars_display_draw(yars_display* d, yars_viewport viewport);
YARS_DISPLAY_API int yars_display_draw_panel(yars_display* d, const yars_panel* panel, yars_viewport viewport);

/* 1: covers the picture with the help, which names what each button does now. Off at first. 0: done. */
YARS_DISPLAY_API int yars_display_show_help(yars_display* d, int on);
/* 1: states without a picture say how to get back, and OFF how to switch on. Off at first. 0: done. */
YARS_DISPLAY_API int yars_display_show_hints(yars_display* d, int on);

/* Presses a button 1..20. 0: sent. Errors: another number; no free input lane. */
YARS_DISPLAY_API int yars_display_press(yars_display* d, int button);
/* Presses the button whose legend is at a position: fractions of the picture's edge from its upper left corner.
 * 1: sent; 0: no legend is there. Errors: no free input lane. */
YARS_DISPLAY_API int yars_display_click(yars_display* d, double right, double down);
/* Number of the button at a position of the square that draw_panel draws: fractions of the square's edge from its upper
 * left corner. bezel: as in yars_panel. 0: none. */
YARS_DISPLAY_API int yars_display_button_at(int bezel, double right, double down);
/* Writes what a button does now, or why it is dead and the remedy: "longer range: 80 NM". `size`: bytes of `text`, with
 * the 0 at its end; a longer text is cut. 0: written. Errors: a button that is not 1..20; a size of 0. */
YARS_DISPLAY_API int yars_display_describe(const yars_display* d, int button, char* text, size_t size);

/* Reports that the last update is visible, for measurements of latency: call it after the swap of buffers. Optional.
 * 0: done. */
YARS_DISPLAY_API int yars_display_note_shown(yars_display* d);

#ifdef __cplusplus
}
#endif

#endif
