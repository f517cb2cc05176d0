#include "watch/display.h"

#include <aureole/text.h>
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "watch/packet.h"
#include "watch/socket.h"

/* Pixels a side of the parts in which a picture is sent, as tev's own client does. */
enum { TILE = 128, DEFAULT_PORT = 14158 };

struct watch_display {
    int connection;
    char name[256];
    pthread_t thread;
    pthread_mutex_t lock; /* guards what follows */
    pthread_cond_t news;
    aur_image *next; /* to be sent */
    bool busy, end;
    int failure; /* the errno of a send that failed */
    /* Of the thread: */
    aur_image *sent; /* what the viewer has */
};

static bool send_packet(watch_display *display, const watch_packet *packet) {
    if (packet->failed) {
        errno = ENOMEM;
        return false;
    }
    for (size_t sent = 0; sent < packet->size;) {
        const ssize_t put =
            send(display->connection, packet->bytes + sent, packet->size - sent, MSG_NOSIGNAL);
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0)
            return false;
        sent += (size_t)put;
    }
    return true;
}

static bool is_alike(const aur_image *a, const aur_image *b) {
    bool alike = a != NULL && aur_image_channel_count(a) == aur_image_channel_count(b) &&
                 aur_image_width(a) == aur_image_width(b) && aur_image_height(a) == aur_image_height(b);
    for (size_t c = 0; alike && c < aur_image_channel_count(a); ++c)
        alike = strcmp(aur_image_channel_name(a, c), aur_image_channel_name(b, c)) == 0;
    return alike;
}

static bool has_changed(const aur_image *before, const aur_image *image, const watch_part *part) {
    const size_t channels = aur_image_channel_count(image);
    for (size_t y = part->y; y < part->y + part->height; ++y) {
        const size_t at = (y * aur_image_width(image) + part->x) * channels;
        if (memcmp(aur_image_data(before) + at, aur_image_data(image) + at,
                   part->width * channels * sizeof(float)) != 0)
            return true;
    }
    return false;
}

/* The first picture makes the viewer's; of all others the parts that have changed are sent. */
static bool send_picture(watch_display *display, const aur_image *image) {
    watch_packet packet = {0};
    bool good = true;
    if (display->sent == NULL) {
        watch_packet_close(&packet, display->name);
        good = send_packet(display, &packet);
        watch_packet_create(&packet, display->name, image);
        good = good && send_packet(display, &packet);
    }
    const bool alike = is_alike(display->sent, image);
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    for (size_t y = 0; good && y < height; y += TILE)
        for (size_t x = 0; good && x < width; x += TILE) {
            const watch_part part = {.x = x,
                                     .y = y,
                                     .width = width - x < TILE ? width - x : TILE,
                                     .height = height - y < TILE ? height - y : TILE};
            if (alike && !has_changed(display->sent, image, &part))
                continue;
            watch_packet_update(&packet, display->name, image, &part);
            good = send_packet(display, &packet);
        }
    free(packet.bytes);
    return good;
}

static void *send_pictures(void *shared) {
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
        const int failure = failed || send_picture(display, image) ? 0 : errno;
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

/* The thread leaves the host's signals to the host's threads. */
static bool start(watch_display *display) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool started = pthread_create(&display->thread, NULL, send_pictures, display) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

aur_result watch_display_create(const char *where, const char *name, watch_display **made, aur_error *error) {
    watch_place place = {.host = "127.0.0.1", .port = DEFAULT_PORT};
    int connection = -1;
    aur_result result = watch_place_read("display-server", where, &place, error);
    if (result == AUR_OK)
        result = watch_connect("display-server", &place, &connection, error);
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
    *made = display;
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
