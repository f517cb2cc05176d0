/* Live display of an image during rendering: a page in a browser, and an image viewer that receives the
 * image. Neither changes the image. */
#pragma once

#include <aureole-render/image.h>

#include "program/report/page/page.h"

typedef struct watch_session watch_session;

/* Both are optional; NULL: off. */
typedef struct watch_options {
    const char *serve;   /* address of the page: "", PORT or HOST:PORT; only local without a host */
    const char *display; /* PORT or HOST:PORT of a display server (display.c) */
    const char *title;   /* of the page, and name of the image */
} watch_options;

/* Errors: ARGUMENT (invalid address), OPEN (cannot listen or connect), MEMORY. */
aur_result watch_create(const watch_options *options, watch_session **created, aur_error *error);
/* A rotation of the camera by the page: degrees to the right and up, and a factor on the distance. */
typedef struct watch_turn {
    double azimuth, elevation, distance;
} watch_turn;

/* From now on pages can turn the camera; watch_progress then returns true after a turn. */
void watch_allow_turns(watch_session *watch);
/* The accumulated turn since the last call; false: none. */
bool watch_take_turn(watch_session *watch, watch_turn *turn);
/* After the render has ended with `image`: waits as long as a page that has turned the camera stays open;
 * true if it turns it again. */
bool watch_wait_for_turn(watch_session *watch, aur_image *image);

/* NULL is allowed. */
void watch_destroy(watch_session *watch);

/* The address of the page: "http://127.0.0.1:40001/5f.../"; NULL without one. */
const char *watch_address(const watch_session *watch);

/* The source of the image during rendering; called by the threads that report progress. */
typedef struct watch_source {
    void *user;
    aur_result (*develop)(void *user, aur_image **image, aur_error *error);
    /* Writes a description of the image, such as its samples and its error, to text[capacity]; may be NULL.
     */
    void (*describe)(void *user, size_t capacity, char *text);
} watch_source;

/* Sets the source of the image; zeros: no image. */
void watch_set_source(watch_session *watch, const watch_source *source);
/* Sets the description of an image whose source has no `describe`; shown with the next progress. */
void watch_describe(watch_session *watch, const char *text);
/* Call with every progress report, `share` from 0 to 1; true if a page requests a stop. One thread at a time.
 */
bool watch_progress(watch_session *watch, const char *what, double share);

/* Why the display server gets no more images: text[capacity], once; otherwise false. */
bool watch_has_lost_display(watch_session *watch, size_t capacity, char *text);

/* The render has ended with `image` or NULL, and the status text `words`: "finished". Waits some seconds for
 * open pages to fetch the image, and sends it to the display server. */
void watch_end(watch_session *watch, const aur_image *image, const char *words);

/* The parts of the page: texts from malloc, NULL when out of memory. */

extern const report_asset watch_assets[]; /* ends without a name */

/* The page, which requests all other parts. */
char *watch_page(const char *title, size_t *size);

/* A layer of an image: three channels, or one. */
typedef struct watch_layer {
    char name[AUR_CHANNEL_NAME_CAPACITY]; /* "albedo" */
    size_t channel, channel_count;
} watch_layer;

enum { WATCH_LAYER_LIMIT = 80 };

/* Three consecutive channels with the same prefix before a dot form one layer, such as R, G, B. Returns the
 * number of layers, at most WATCH_LAYER_LIMIT. */
size_t watch_layers(const aur_image *image, watch_layer layers[WATCH_LAYER_LIMIT]);

/* A layer of an image as JSON for `unpack` of src/program/report/page/images.js. */
char *watch_layer_json(const aur_image *image, const watch_layer *layer, size_t *size);

/* Sends the image to a viewer on the network with the protocol of tev (Müller), which pbrt-v4 uses too:
 * little-endian packets over TCP, each with its size (uint32), a type (uint8) and its data. */

typedef struct watch_display watch_display;

/* Connects to "PORT" or "HOST:PORT"; `name` is the image's name there, which replaces an earlier one. Errors:
 * ARGUMENT, OPEN, MEMORY. */
aur_result watch_display_create(const char *where, const char *name, watch_display **display,
                                aur_error *error);
void watch_display_destroy(watch_display *display); /* NULL is allowed */

/* Whether another image would be sent immediately. */
bool watch_display_is_free(watch_display *display);
/* Sends the changes since the last image; takes ownership of the image. Thread-safe. */
void watch_display_show(watch_display *display, aur_image *image);
/* Waits until everything is sent or sending fails; no image may follow. */
void watch_display_finish(watch_display *display);
/* Why sending has failed: text[capacity]; false if it has not. */
bool watch_display_has_failed(watch_display *display, size_t capacity, char *text);
