#include "program/watch/watch.h"

#include <aureole/text.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <time.h>
#include <unistd.h>

#include "program/watch/server.h"

enum { TOKEN_BYTES = 16, TOKEN_LENGTH = 2 * TOKEN_BYTES, TEXT_CAPACITY = 256, MOST_PAGES = 16 };

/* Seconds between status updates, the fraction of time for developing images, and how long the end waits for
 * silent and for active pages. */
static const double PAUSE = 0.2, DEVELOPING_PART = 0.05, SILENCE = 3.0, GOODBYE = 60.0;

/* A page that is open in a browser. */
typedef struct open_page {
    uint64_t id;
    bool has_all; /* it has fetched the final image */
} open_page;

struct watch_session {
    char token[TOKEN_LENGTH + 1], address[WATCH_HOST_CAPACITY + TOKEN_LENGTH + 32], title[TEXT_CAPACITY];
    watch_server *server;
    watch_display *display;
    bool display_lost; /* and it was reported */
    atomic_bool stop;
    /* Only used by the thread that reports progress: */
    watch_source source;
    char pending[TEXT_CAPACITY]; /* description of the image for the next status */
    double updated, developed,
        cost;             /* time of the last status and of the last development, and its seconds */
    pthread_mutex_t lock; /* protects the following members */
    uint64_t serial;      /* version number of the state */
    char what[TEXT_CAPACITY], description[TEXT_CAPACITY], ended[TEXT_CAPACITY];
    double share;
    bool turns, has_turned; /* pages may turn the camera; a page has turned it */
    bool turned;            /* `turn` has not been applied yet */
    watch_turn turn;
    bool image_requested;  /* a page requests a newer image */
    aur_image *fresh;      /* for the server's thread to take */
    const aur_image *last; /* the final image, owned by the caller */
    double requested_at;   /* the time of the last request */
    size_t page_count;
    open_page pages[MOST_PAGES];
    /* Only used by the server's thread: */
    aur_image *taken;       /* the image that it has taken */
    const aur_image *shown; /* that image or the final one */
    uint64_t version;
    size_t layer_count;
    watch_layer layers[WATCH_LAYER_LIMIT];
};

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* --- answers, in the server's thread */

static bool answer_text(watch_answer *answer, int status, const char *type, char *body, size_t size) {
    *answer = body != NULL || status != 200 ? (watch_answer){status, type, size, body}
                                            : (watch_answer){.status = 500};
    return true;
}

static bool answer_status(watch_answer *answer, int status) {
    return answer_text(answer, status, NULL, NULL, 0);
}

static void take_over(watch_session *watch) {
    pthread_mutex_lock(&watch->lock);
    aur_image *const fresh = watch->fresh;
    watch->fresh = NULL;
    const aur_image *const newest = watch->last != NULL ? watch->last : fresh;
    pthread_mutex_unlock(&watch->lock);
    if (fresh != NULL) {
        aur_image_destroy(watch->taken);
        watch->taken = fresh;
    }
    if (newest == NULL || newest == watch->shown)
        return;
    watch->shown = newest;
    watch->layer_count = watch_layers(newest, watch->layers);
    ++watch->version;
}

static void put_layers(aur_json *json, const watch_session *watch) {
    aur_json_name(json, "layers");
    aur_json_open(json, '[', false);
    for (size_t l = 0; l < watch->layer_count; ++l) {
        const watch_layer *const layer = &watch->layers[l];
        aur_json_open(json, '{', false);
        aur_json_name(json, "name");
        aur_json_string(json, layer->name);
        aur_json_name(json, "channels");
        aur_json_open(json, '[', false);
        for (size_t c = 0; c < layer->channel_count; ++c)
            aur_json_string(json, aur_image_channel_name(watch->shown, layer->channel + c));
        aur_json_close(json, ']');
        aur_json_close(json, '}');
    }
    aur_json_close(json, ']');
}

static char *state_text(watch_session *watch, size_t *size) {
    char *text = NULL;
    aur_json json = {.stream = open_memstream(&text, size)};
    if (json.stream == NULL)
        return NULL;
    aur_json_open(&json, '{', false);
    pthread_mutex_lock(&watch->lock);
    const char *const texts[][2] = {
        {"what", watch->what}, {"known", watch->description}, {"ended", watch->ended}};
    for (size_t i = 0; i < 3; ++i) {
        aur_json_name(&json, texts[i][0]);
        aur_json_string(&json, texts[i][1]);
    }
    aur_json_name(&json, "serial");
    aur_json_integer(&json, watch->serial);
    aur_json_name(&json, "share");
    aur_json_number(&json, watch->share);
    aur_json_name(&json, "turns");
    aur_json_boolean(&json, watch->turns);
    pthread_mutex_unlock(&watch->lock);
    aur_json_name(&json, "version");
    aur_json_integer(&json, watch->version);
    aur_json_name(&json, "width");
    aur_json_integer(&json, watch->shown != NULL ? aur_image_width(watch->shown) : 0);
    aur_json_name(&json, "height");
    aur_json_integer(&json, watch->shown != NULL ? aur_image_height(watch->shown) : 0);
    put_layers(&json, watch);
    aur_json_close(&json, '}');
    if (fclose(json.stream) == 0)
        return text;
    free(text);
    return NULL;
}

/* Requires the lock. With too many pages the last one is replaced. */
static open_page *page_of(watch_session *watch, uint64_t id) {
    for (size_t i = 0; i < watch->page_count; ++i)
        if (watch->pages[i].id == id)
            return &watch->pages[i];
    watch->page_count += watch->page_count < MOST_PAGES;
    open_page *const page = &watch->pages[watch->page_count - 1];
    *page = (open_page){.id = id};
    return page;
}

/* "state/PAGE/SERIAL": answers when the state is newer than SERIAL. */
static bool answer_state(watch_session *watch, const char *text, bool last, watch_answer *answer) {
    char id_text[24] = "";
    uint64_t id = 0, shown_serial = 0;
    const size_t length = strcspn(text, "/");
    if (length >= sizeof id_text || text[length] != '/' ||
        !aur_parse_integer(memcpy(id_text, text, length), UINT64_MAX, &id) ||
        !aur_parse_integer(text + length + 1, UINT64_MAX, &shown_serial))
        return answer_status(answer, 404);
    pthread_mutex_lock(&watch->lock);
    page_of(watch, id);
    watch->requested_at = now();
    watch->image_requested = true;
    const bool news = watch->serial > shown_serial || last;
    pthread_mutex_unlock(&watch->lock);
    if (!news)
        return false;
    take_over(watch);
    size_t size = 0;
    char *const body = state_text(watch, &size);
    return answer_text(answer, 200, "application/json", body, size);
}

static bool answer_layer(watch_session *watch, const char *text, watch_answer *answer) {
    uint64_t layer = 0;
    take_over(watch);
    pthread_mutex_lock(&watch->lock);
    watch->requested_at = now();
    pthread_mutex_unlock(&watch->lock);
    if (!aur_parse_integer(text, WATCH_LAYER_LIMIT, &layer) || layer >= watch->layer_count)
        return answer_status(answer, 404);
    size_t size = 0;
    char *const body = watch_layer_json(watch->shown, &watch->layers[layer], &size);
    return answer_text(answer, 200, "application/json", body, size);
}

static bool answer_goodbye(watch_session *watch, const char *text, watch_answer *answer) {
    uint64_t id = 0;
    if (!aur_parse_integer(text, UINT64_MAX, &id))
        return answer_status(answer, 404);
    pthread_mutex_lock(&watch->lock);
    page_of(watch, id)->has_all = true;
    pthread_mutex_unlock(&watch->lock);
    return answer_text(answer, 200, NULL, strdup("Goodbye.\n"), strlen("Goodbye.\n"));
}

/* "turn/AZIMUTH/ELEVATION/DISTANCE": accumulates a turn. */
static bool answer_turn(watch_session *watch, const char *text, watch_answer *answer) {
    double numbers[3];
    for (size_t i = 0; i < 3; ++i) {
        char piece[32] = "";
        const size_t length = strcspn(text, "/");
        if (length >= sizeof piece || !aur_parse_double(memcpy(piece, text, length), &numbers[i]) ||
            !(fabs(numbers[i]) <= 1e4) || (text[length] == '/') != (i < 2))
            return answer_status(answer, 404);
        text += length + (i < 2);
    }
    pthread_mutex_lock(&watch->lock);
    const bool allowed = watch->turns && numbers[2] > 1e-4;
    if (allowed) {
        watch_turn *const turn = &watch->turn;
        *turn = watch->turned ? *turn : (watch_turn){.distance = 1.0};
        turn->azimuth += numbers[0];
        turn->elevation += numbers[1];
        turn->distance = fmin(fmax(turn->distance * numbers[2], 1e-3), 1e3);
        watch->has_turned = true; /* also for the identity, which a page sends first */
        watch->turned = watch->turned || numbers[0] != 0.0 || numbers[1] != 0.0 || numbers[2] != 1.0;
    }
    pthread_mutex_unlock(&watch->lock);
    return allowed ? answer_text(answer, 200, NULL, strdup("Turning.\n"), strlen("Turning.\n"))
                   : answer_status(answer, 404);
}

/* The path after "/TOKEN/", or NULL. Constant-time comparison, so that timing reveals nothing about the
 * token. */
static const char *after_token(const watch_session *watch, const char *target) {
    unsigned char difference = 0;
    if (strlen(target) < TOKEN_LENGTH + 2 || target[TOKEN_LENGTH + 1] != '/')
        return NULL;
    for (size_t i = 0; i < TOKEN_LENGTH; ++i)
        difference |= (unsigned char)(target[1 + i] ^ watch->token[i]);
    return difference == 0 ? target + TOKEN_LENGTH + 2 : NULL;
}

static bool handle(void *user, const char *method, const char *target, bool last, watch_answer *answer) {
    watch_session *const watch = user;
    const char *const what = after_token(watch, target);
    const bool reads = strcmp(method, "GET") == 0 || strcmp(method, "HEAD") == 0;
    const bool acts = what != NULL && (strcmp(what, "stop") == 0 || strncmp(what, "bye/", 4) == 0 ||
                                       strncmp(what, "turn/", 5) == 0);
    if (what == NULL)
        return answer_status(answer, 404);
    if (acts ? strcmp(method, "POST") != 0 : !reads)
        return answer_status(answer, 405);
    if (what[0] == '\0') {
        size_t size = 0;
        char *const body = watch_page(watch->title, &size);
        return answer_text(answer, 200, "text/html; charset=utf-8", body, size);
    }
    if (strncmp(what, "state/", 6) == 0)
        return answer_state(watch, what + 6, last, answer);
    if (strncmp(what, "image/", 6) == 0)
        return answer_layer(watch, what + 6, answer);
    if (!acts)
        return answer_status(answer, 404);
    if (what[0] == 't')
        return answer_turn(watch, what + 5, answer);
    if (what[0] == 'b')
        return answer_goodbye(watch, what + 4, answer);
    atomic_store(&watch->stop, true);
    return answer_text(answer, 200, NULL, strdup("Stopping.\n"), strlen("Stopping.\n"));
}

/* --- creation */

static aur_result make_token(watch_session *watch, aur_error *error) {
    unsigned char bytes[TOKEN_BYTES];
    if (getrandom(bytes, sizeof bytes, 0) != (ssize_t)sizeof bytes)
        return aur_fail(error, AUR_ERROR_INTERNAL, "--serve: the system has no random numbers");
    for (size_t i = 0; i < TOKEN_BYTES; ++i)
        aur_format(watch->token + 2 * i, 3, "%02x", bytes[i]);
    return AUR_OK;
}

static aur_result begin_serving(watch_session *watch, const char *where, aur_error *error) {
    watch_endpoint endpoint = {.host = "127.0.0.1"};
    aur_result result = watch_endpoint_parse("serve", where, &endpoint, error);
    if (result == AUR_OK)
        result = make_token(watch, error);
    if (result == AUR_OK)
        result = watch_server_create("serve", &endpoint, handle, watch, &watch->server, error);
    if (result != AUR_OK)
        return result;
    /* Wildcard addresses are replaced by the host name, because browsers cannot open them. */
    if (strcmp(endpoint.host, "0.0.0.0") == 0 || strcmp(endpoint.host, "::") == 0)
        gethostname(endpoint.host, sizeof endpoint.host - 1);
    char text[WATCH_HOST_CAPACITY + 16];
    watch_endpoint_format(&endpoint, sizeof text, text);
    aur_format(watch->address, sizeof watch->address, "http://%s/%s/", text, watch->token);
    return AUR_OK;
}

aur_result watch_create(const watch_options *options, watch_session **created, aur_error *error) {
    *created = NULL;
    watch_session *const watch = calloc(1, sizeof *watch);
    if (watch == NULL || pthread_mutex_init(&watch->lock, NULL) != 0) {
        free(watch);
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    }
    atomic_init(&watch->stop, false);
    watch->serial = 1;
    aur_format(watch->what, sizeof watch->what, "planning");
    aur_format(watch->title, sizeof watch->title, "%s", options->title);
    aur_result result = options->serve != NULL ? begin_serving(watch, options->serve, error) : AUR_OK;
    if (result == AUR_OK && options->display != NULL)
        result = watch_display_create(options->display, watch->title, &watch->display, error);
    if (result == AUR_OK)
        *created = watch;
    else
        watch_destroy(watch);
    return result;
}

void watch_destroy(watch_session *watch) {
    if (watch == NULL)
        return;
    watch_server_destroy(watch->server);
    watch_display_destroy(watch->display);
    aur_image_destroy(watch->fresh);
    aur_image_destroy(watch->taken);
    pthread_mutex_destroy(&watch->lock);
    free(watch);
}

const char *watch_address(const watch_session *watch) {
    return watch->server != NULL ? watch->address : NULL;
}

/* --- the render's side */

void watch_set_source(watch_session *watch, const watch_source *source) {
    if (watch->source.describe != NULL) /* its final description */
        watch->source.describe(watch->source.user, sizeof watch->pending, watch->pending);
    watch->source = *source;
}

void watch_describe(watch_session *watch, const char *text) {
    aur_format(watch->pending, sizeof watch->pending, "%s", text);
}

/* Develops images for the pages, returned, and for the display server, if requested and within the time
 * budget. */
static aur_image *develop(watch_session *watch) {
    pthread_mutex_lock(&watch->lock);
    const bool image_requested = watch->image_requested && watch->fresh == NULL;
    pthread_mutex_unlock(&watch->lock);
    const bool sends = watch->display != NULL && watch_display_is_free(watch->display);
    const double begin = now();
    const watch_source *const source = &watch->source;
    aur_image *image = NULL, *fresh = NULL;
    if ((!image_requested && !sends) || source->develop == NULL ||
        begin - watch->developed < watch->cost / DEVELOPING_PART)
        return NULL;
    if (sends && source->develop(source->user, &image, NULL) == AUR_OK)
        watch_display_show(watch->display, image);
    if (image_requested && source->develop(source->user, &fresh, NULL) != AUR_OK)
        fresh = NULL;
    watch->developed = now();
    watch->cost = watch->developed - begin;
    return fresh;
}

void watch_allow_turns(watch_session *watch) {
    pthread_mutex_lock(&watch->lock);
    watch->turns = true;
    pthread_mutex_unlock(&watch->lock);
}

static bool is_turned(watch_session *watch) {
    pthread_mutex_lock(&watch->lock);
    const bool turned = watch->turned;
    pthread_mutex_unlock(&watch->lock);
    return turned;
}

bool watch_take_turn(watch_session *watch, watch_turn *turn) {
    pthread_mutex_lock(&watch->lock);
    const bool turned = watch->turned && !atomic_load(&watch->stop);
    *turn = watch->turn;
    watch->turned = false;
    watch->share = 0.0;
    pthread_mutex_unlock(&watch->lock);
    watch->developed = watch->cost = watch->updated = 0.0; /* the first image is shown immediately */
    return turned;
}

/* Copies up to MOST_CHANNELS channels of an image. */
static aur_result copy_of(const aur_image *from, aur_image **image, aur_error *error) {
    enum { MOST_CHANNELS = 128 };
    const char *names[MOST_CHANNELS];
    const size_t all = aur_image_channel_count(from), count = all < MOST_CHANNELS ? all : MOST_CHANNELS;
    for (size_t c = 0; c < count; ++c)
        names[c] = aur_image_channel_name(from, c);
    return aur_image_select(from, count, names, image, error);
}

static aur_result develop_finished(void *user, aur_image **image, aur_error *error) {
    return copy_of(user, image, error);
}

bool watch_wait_for_turn(watch_session *watch, aur_image *image) {
    const struct timespec moment = {.tv_nsec = 50000000};
    watch_set_source(watch, &(watch_source){.user = image, .develop = develop_finished});
    watch->cost = 0.0;
    for (bool open = true; open && !is_turned(watch); nanosleep(&moment, NULL)) {
        pthread_mutex_lock(&watch->lock);
        open = watch->has_turned && now() - watch->requested_at < SILENCE;
        for (size_t i = 0, finished = 0; i < watch->page_count; ++i)
            open = open && (finished += watch->pages[i].has_all) < watch->page_count;
        pthread_mutex_unlock(&watch->lock);
        open = open && !watch_progress(watch, "finished: turn the camera, or stop", 1.0);
    }
    watch_set_source(watch, &(watch_source){0});
    return is_turned(watch);
}

bool watch_progress(watch_session *watch, const char *what, double share) {
    if (atomic_load(&watch->stop) || is_turned(watch))
        return true;
    const double time = now();
    if (time - watch->updated < PAUSE)
        return false;
    watch->updated = time;
    if (watch->source.describe != NULL)
        watch->source.describe(watch->source.user, sizeof watch->pending, watch->pending);
    aur_image *const fresh = develop(watch);
    pthread_mutex_lock(&watch->lock); /* updates text, fraction and image together */
    aur_format(watch->what, sizeof watch->what, "%s", what != NULL ? what : "working");
    memcpy(watch->description, watch->pending, sizeof watch->description);
    if (fresh != NULL) {
        watch->fresh = fresh;
        watch->image_requested = false;
    }
    watch->share = share;
    ++watch->serial;
    pthread_mutex_unlock(&watch->lock);
    if (watch->server != NULL)
        watch_server_wake(watch->server);
    return false;
}

/* Whether to wait for pages that have not fetched the final image. */
static bool is_waited_for(watch_session *watch, double ended) {
    bool waited = false;
    pthread_mutex_lock(&watch->lock);
    for (size_t i = 0; i < watch->page_count; ++i)
        waited = waited || !watch->pages[i].has_all;
    const double last = fmax(watch->requested_at, ended), time = now();
    waited = waited && time - last < SILENCE && time - ended < GOODBYE;
    pthread_mutex_unlock(&watch->lock);
    return waited;
}

bool watch_has_lost_display(watch_session *watch, size_t capacity, char *text) {
    if (watch->display == NULL || watch->display_lost ||
        !watch_display_has_failed(watch->display, capacity, text))
        return false;
    watch->display_lost = true;
    return true;
}

/* Sends the complete final image. */
static void send_last(watch_session *watch, const aur_image *image) {
    aur_image *copy = NULL;
    if (copy_of(image, &copy, NULL) == AUR_OK)
        watch_display_show(watch->display, copy);
    watch_display_finish(watch->display);
}

void watch_end(watch_session *watch, const aur_image *image, const char *words) {
    watch->source = (watch_source){0};
    if (watch->display != NULL && image != NULL)
        send_last(watch, image);
    if (watch->server == NULL)
        return;
    pthread_mutex_lock(&watch->lock);
    aur_format(watch->ended, sizeof watch->ended, "%s", words);
    memcpy(watch->description, watch->pending, sizeof watch->description); /* of the complete image */
    watch->last = image;
    ++watch->serial;
    pthread_mutex_unlock(&watch->lock);
    watch_server_wake(watch->server);
    const struct timespec moment = {.tv_nsec = 20000000};
    for (const double ended = now(); is_waited_for(watch, ended);)
        nanosleep(&moment, NULL);
    watch_server_destroy(watch->server);
    watch->server = NULL;
}
