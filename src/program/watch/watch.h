/* Watching an image while it is rendered: a page that a browser opens, and an image viewer that is sent the
 * image. None of it changes the image. */
#pragma once

#include <aureole-render/image.h>

#include "program/report/page/page.h"

typedef struct watch_session watch_session;

/* Both may be asked for; NULL: it is not. */
typedef struct watch_options {
    const char *serve;   /* "", PORT or HOST:PORT: where the page is, on this machine alone without a host */
    const char *display; /* PORT or HOST:PORT of a display server (display.c) */
    const char *title;   /* the page's, and the image's name */
} watch_options;

/* Errors: ARGUMENT (no such place), OPEN (it cannot be listened at or connected to), MEMORY. */
aur_result watch_create(const watch_options *options, watch_session **made, aur_error *error);
/* How far somebody has turned the camera in the page: degrees to the right and up, and a factor of the
 * distance. */
typedef struct watch_turn {
    double azimuth, elevation, distance;
} watch_turn;

/* From now on pages can turn the camera; watch_progress is true when one has. */
void watch_allow_turns(watch_session *watch);
/* What pages have turned since the last call; false: nothing. */
bool watch_take_turn(watch_session *watch, watch_turn *turn);
/* Waits, when the render has ended with `image`, as long as a page that has turned the camera stays open;
 * true when it has turned it again. */
bool watch_wait_for_turn(watch_session *watch, aur_image *image);

/* NULL is allowed. */
void watch_destroy(watch_session *watch);

/* Where the page is: "http://127.0.0.1:40001/5f.../"; NULL where there is none. */
const char *watch_address(const watch_session *watch);

/* Where the image comes from while it is rendered, in whichever thread reports progress. */
typedef struct watch_source {
    const void *user;
    aur_result (*develop)(const void *user, aur_image **image, aur_error *error);
    /* Writes what is known of the image, such as its samples and its error, to text[capacity]; may be NULL.
     */
    void (*describe)(const void *user, size_t capacity, char *text);
} watch_source;

/* From now on there is an image; with a source of zeros there is none any more. */
void watch_set_source(watch_session *watch, const watch_source *source);
/* What is known of the image, where the source does not describe it; shown with the next progress. */
void watch_tell(watch_session *watch, const char *text);
/* To be called with the progress, `share` from 0 to 1; true when somebody has asked for the render to stop.
 * One thread at a time. */
bool watch_progress(watch_session *watch, const char *what, double share);

/* Why a display server gets no more: text[capacity], once; else false. */
bool watch_has_lost_display(watch_session *watch, size_t capacity, char *text);

/* The render has ended with the image `image`, or NULL, which `words` say: "finished". Pages that are open
 * are given some seconds to fetch it, and a display server is sent it. */
void watch_end(watch_session *watch, const aur_image *image, const char *words);

/* What the page of a render that is watched consists of: texts from memory that the caller frees, NULL when
 * there is none left. */

extern const report_asset watch_assets[]; /* ends without a name */

/* The page itself, which asks for all else. */
char *watch_page(const char *title, size_t *size);

/* A part of an image that is seen at once: three channels, or one. */
typedef struct watch_layer {
    char name[AUR_CHANNEL_NAME_CAPACITY]; /* "albedo" */
    size_t channel, channel_count;
} watch_layer;

enum { WATCH_LAYER_LIMIT = 80 };

/* Channels in turn whose names have the same beginning before a dot are one layer where they are three, such
 * as R, G, B. Returns how many layers there are, at most WATCH_LAYER_LIMIT. */
size_t watch_layers(const aur_image *image, watch_layer layers[WATCH_LAYER_LIMIT]);

/* One layer of an image as `unpack` of src/program/report/page/pictures.js takes it. */
char *watch_picture(const aur_image *image, const watch_layer *layer, size_t *size);

/* The image sent to an image viewer on the network, by the protocol of tev (Müller), which pbrt-v4 speaks
 * too: little-endian packets over TCP, each the count of its bytes (uint32), a kind (uint8) and what belongs
 * to it. */

typedef struct watch_display watch_display;

/* Connects to "PORT" or "HOST:PORT"; `name` is the image's there, where an earlier one of that name is
 * closed. Errors: ARGUMENT, OPEN, MEMORY. */
aur_result watch_display_create(const char *where, const char *name, watch_display **display,
                                aur_error *error);
void watch_display_destroy(watch_display *display); /* NULL is allowed */

/* Whether another image would be sent at once. */
bool watch_display_is_free(watch_display *display);
/* Sends what has changed since the last image; takes the image over. From any thread. */
void watch_display_show(watch_display *display, aur_image *image);
/* Waits until all is sent or nothing can be; then nothing more is to be shown. */
void watch_display_finish(watch_display *display);
/* Why nothing is sent any more: text[capacity]; false where all is well. */
bool watch_display_has_failed(watch_display *display, size_t capacity, char *text);
