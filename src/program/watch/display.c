#include "program/watch/watch.h"

#include <aureole/text.h>
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "program/watch/server.h"

/* Pixels per side of the tiles in which an image is sent, as in tev's client. */
enum { TILE = 128, DEFAULT_PORT = 14158 };

struct watch_display {
    int connection;
    char name[256];
    pthread_t thread;
    pthread_mutex_t lock; /* protects the following members */
    pthread_cond_t news;
    aur_image *next; /* to be sent */
    bool busy, end;
    int failure; /* errno of a failed send */
    /* Only used by the thread: */
    aur_image *sent; /* the image that the viewer has */
};

/* --- packets */

/* Kinds of packets. */
enum { CLOSE_IMAGE = 2, CREATE_IMAGE = 4, UPDATE_IMAGE_3 = 6 };

/* A rectangle of an image, in pixels. */
typedef struct image_part {
    size_t x, y, width, height;
} image_part;

/* The low `count` bytes in little-endian order. */
static void put_number(FILE *packet, size_t count, uint64_t value) {
    for (size_t i = 0; i < count; ++i)
        putc_unlocked((int)(value >> 8 * i & 255), packet);
}

static void put_text(FILE *packet, const char *text) {
    fwrite(text, 1, strlen(text) + 1, packet);
}

static void put_channels(FILE *packet, const aur_image *image) {
    const size_t channels = aur_image_channel_count(image);
    put_number(packet, 4, channels);
    for (size_t c = 0; c < channels; ++c)
        put_text(packet, aur_image_channel_name(image, c));
}

/* The size and the channels of `image`, for a new black image. */
static void put_creation(FILE *packet, const char *name, const aur_image *image) {
    put_number(packet, 1, 1); /* select it in the viewer */
    put_text(packet, name);
    put_number(packet, 4, aur_image_width(image));
    put_number(packet, 4, aur_image_height(image));
    put_channels(packet, image);
}

/* A rectangle of the image with interleaved channels. */
static void put_update(FILE *packet, const char *name, const aur_image *image, const image_part *part) {
    const size_t channels = aur_image_channel_count(image);
    put_number(packet, 1, 0);
    put_text(packet, name);
    put_channels(packet, image);
    put_number(packet, 4, part->x);
    put_number(packet, 4, part->y);
    put_number(packet, 4, part->width);
    put_number(packet, 4, part->height);
    for (size_t c = 0; c < channels; ++c) /* offset of its first value */
        put_number(packet, 8, c);
    for (size_t c = 0; c < channels; ++c) /* stride of its values */
        put_number(packet, 8, channels);
    for (size_t y = part->y; y < part->y + part->height; ++y) {
        const float *const line = aur_image_data(image) + (y * aur_image_width(image) + part->x) * channels;
        for (size_t i = 0; i < part->width * channels; ++i) {
            uint32_t bits;
            memcpy(&bits, &line[i], sizeof bits);
            put_number(packet, 4, bits);
        }
    }
}

static bool send_bytes(int connection, size_t size, const char *bytes) {
    for (size_t sent = 0; sent < size;) {
        const ssize_t count = send(connection, bytes + sent, size - sent, MSG_NOSIGNAL);
        if (count < 0 && errno != EINTR)
            return false;
        sent += count > 0 ? (size_t)count : 0;
    }
    return true;
}

/* Sends a packet; an update has a rectangle, and CLOSE_IMAGE needs no image. */
static bool send_packet(const watch_display *display, unsigned kind, const aur_image *image,
                        const image_part *part) {
    char *bytes = NULL;
    size_t size = 0;
    FILE *const packet = open_memstream(&bytes, &size);
    if (packet == NULL)
        return false;
    put_number(packet, 4, 0); /* the size is written last */
    put_number(packet, 1, kind);
    if (kind == CREATE_IMAGE)
        put_creation(packet, display->name, image);
    else if (kind == UPDATE_IMAGE_3)
        put_update(packet, display->name, image, part);
    else
        put_text(packet, display->name);
    const bool complete = !ferror(packet);
    const bool good = fclose(packet) == 0 && complete;
    for (size_t i = 0; good && i < 4; ++i)
        bytes[i] = (char)(size >> 8 * i & 255);
    const bool sent = good && send_bytes(display->connection, size, bytes);
    const int failure = good ? errno : ENOMEM;
    free(bytes);
    errno = failure;
    return sent;
}

static bool is_compatible(const aur_image *a, const aur_image *b) {
    bool compatible = a != NULL && aur_image_channel_count(a) == aur_image_channel_count(b) &&
                      aur_image_width(a) == aur_image_width(b) && aur_image_height(a) == aur_image_height(b);
    for (size_t c = 0; compatible && c < aur_image_channel_count(a); ++c)
        compatible = strcmp(aur_image_channel_name(a, c), aur_image_channel_name(b, c)) == 0;
    return compatible;
}

static bool has_changed(const aur_image *before, const aur_image *image, const image_part *part) {
    const size_t channels = aur_image_channel_count(image);
    for (size_t y = part->y; y < part->y + part->height; ++y) {
        const size_t at = (y * aur_image_width(image) + part->x) * channels;
        if (memcmp(aur_image_data(before) + at, aur_image_data(image) + at,
                   part->width * channels * sizeof(float)) != 0)
            return true;
    }
    return false;
}

/* The first image is created in the viewer; later only changed tiles are sent. */
static bool send_image(const watch_display *display, const aur_image *image) {
    bool good = display->sent != NULL || (send_packet(display, CLOSE_IMAGE, NULL, NULL) &&
                                          send_packet(display, CREATE_IMAGE, image, NULL));
    const bool compatible = is_compatible(display->sent, image);
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    for (size_t y = 0; good && y < height; y += TILE)
        for (size_t x = 0; good && x < width; x += TILE) {
            const image_part part = {.x = x,
                                     .y = y,
                                     .width = width - x < TILE ? width - x : TILE,
                                     .height = height - y < TILE ? height - y : TILE};
            if (!compatible || has_changed(display->sent, image, &part))
                good = send_packet(display, UPDATE_IMAGE_3, image, &part);
        }
    return good;
}

static void *send_images(void *shared) {
    watch_display *const display = shared;
    pthread_mutex_lock(&display->lock);
    for (;;) {
        while (display->next == NULL && !display->end)
            pthread_cond_wait(&display->news, &display->lock);
        aur_image *const image = display->next;
        display->next = NULL;
        if (image == NULL)
            break;
        display->busy = true;
        const bool failed = display->failure != 0;
        pthread_mutex_unlock(&display->lock);
        const int failure = failed || send_image(display, image) ? 0 : errno;
        aur_image_destroy(display->sent);
        display->sent = image;
        pthread_mutex_lock(&display->lock);
        display->busy = false;
        if (failure != 0)
            display->failure = failure;
    }
    pthread_mutex_unlock(&display->lock);
    return NULL;
}

/* Signals are for the host's threads. */
static bool start(watch_display *display) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool started = pthread_create(&display->thread, NULL, send_images, display) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

aur_result watch_display_create(const char *where, const char *name, watch_display **created,
                                aur_error *error) {
    watch_endpoint endpoint = {.host = "127.0.0.1", .port = DEFAULT_PORT};
    int connection = -1;
    aur_result result = watch_endpoint_parse("display-server", where, &endpoint, error);
    if (result == AUR_OK)
        result = watch_connect("display-server", &endpoint, &connection, error);
    if (result != AUR_OK)
        return result;
    watch_display *const display = calloc(1, sizeof *display);
    if (display != NULL) {
        display->connection = connection;
        aur_format(display->name, sizeof display->name, "%s", name);
        pthread_mutex_init(&display->lock, NULL);
        pthread_cond_init(&display->news, NULL);
    }
    if (display == NULL || !start(display)) {
        free(display);
        close(connection);
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    }
    *created = display;
    return AUR_OK;
}

void watch_display_finish(watch_display *display) {
    if (display->end)
        return;
    pthread_mutex_lock(&display->lock);
    display->end = true;
    pthread_cond_signal(&display->news);
    pthread_mutex_unlock(&display->lock);
    pthread_join(display->thread, NULL);
}

void watch_display_destroy(watch_display *display) {
    if (display == NULL)
        return;
    watch_display_finish(display);
    pthread_cond_destroy(&display->news);
    pthread_mutex_destroy(&display->lock);
    aur_image_destroy(display->sent);
    close(display->connection);
    free(display);
}

bool watch_display_is_free(watch_display *display) {
    pthread_mutex_lock(&display->lock);
    const bool is_free = display->next == NULL && !display->busy && display->failure == 0;
    pthread_mutex_unlock(&display->lock);
    return is_free;
}

void watch_display_show(watch_display *display, aur_image *image) {
    pthread_mutex_lock(&display->lock);
    aur_image_destroy(display->next);
    display->next = image;
    pthread_cond_signal(&display->news);
    pthread_mutex_unlock(&display->lock);
}

bool watch_display_has_failed(watch_display *display, size_t capacity, char *text) {
    pthread_mutex_lock(&display->lock);
    const int failure = display->failure;
    pthread_mutex_unlock(&display->lock);
    if (failure != 0)
        aur_format(text, capacity, "the display server is lost: %s", strerror(failure));
    return failure != 0;
}
