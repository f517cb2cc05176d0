#define _GNU_SOURCE /* pthread_setattr_default_np */
#include "check.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "points/base/parallel.h"

/* The address sanitizer maps terabytes, which no limit of memory lets it do. */
#if defined(__SANITIZE_ADDRESS__)
#define LIMITS_HOLD 0
#else
#define LIMITS_HOLD 1
#endif

enum { ITEMS = 1000 };

typedef struct visits {
    atomic_int count[ITEMS];
    size_t failing[2];
} visits;

static aur_result visit(void *context, size_t index) {
    visits *const v = context;
    atomic_fetch_add(&v->count[index], 1);
    return index == v->failing[0] ? AUR_ERROR_FORMAT : index == v->failing[1] ? AUR_ERROR_NAME : AUR_OK;
}

static void does_each_item_once(void **state) {
    (void)state;
    for (size_t threads = 0; threads <= 5; ++threads) {
        visits v = {.failing = {ITEMS, ITEMS}};
        const aur_parallel_options options = {.threads = threads};
        assert_int_equal(aur_parallel_for(&options, ITEMS, visit, &v, NULL), AUR_OK);
        for (size_t i = 0; i < ITEMS; ++i)
            assert_int_equal(atomic_load(&v.count[i]), 1);
    }
    assert_int_equal(aur_parallel_for(NULL, 0, visit, NULL, NULL), AUR_OK);
}

static void returns_the_first_failure(void **state) {
    (void)state;
    visits v = {.failing = {40, 41}};
    const aur_parallel_options options = {.threads = 1, .what = "visiting"};
    aur_error error;
    assert_int_equal(aur_parallel_for(&options, ITEMS, visit, &v, &error), AUR_ERROR_FORMAT);
    assert_int_equal(error.result, AUR_ERROR_FORMAT);
    assert_string_equal(error.message, "visiting: malformed input");
    assert_int_equal(atomic_load(&v.count[40]), 1);
    assert_int_equal(atomic_load(&v.count[41]), 0);
}

/* An excessive number of threads is reduced to what the process can use. */
static void clamps_the_number_of_threads(void **state) {
    (void)state;
    assert_int_equal(aur_parallel_threads(1), 1);
    assert_in_range(aur_parallel_threads(0), 1, 1024);
    assert_in_range(aur_parallel_threads(SIZE_MAX), 16, 1024);
    setenv("OMP_NUM_THREADS", "3,2", 1);
    assert_int_equal(aur_parallel_threads(0), 3);
    assert_int_equal(aur_parallel_threads(2), 2);
    setenv("OMP_NUM_THREADS", "many", 1);
    assert_in_range(aur_parallel_threads(0), 1, 1024);
    unsetenv("OMP_NUM_THREADS");
}

/* Regression: libgomp ended the host here with exit(1). Half a gigabyte beyond the mapped memory is not
 * enough for sixteen stacks of 64 MiB. */
static void works_without_threads_to_be_had(void **state) {
    (void)state;
    if (!LIMITS_HOLD)
        skip();
    const pid_t child = fork();
    if (child == 0) {
        const struct rlimit stack = {64 << 20, 64 << 20};
        pthread_attr_t attributes;
        pthread_attr_init(&attributes);
        pthread_attr_setstacksize(&attributes, 64 << 20);
        pthread_setattr_default_np(&attributes);
        const struct rlimit memory = {512 << 20, 512 << 20};
        if (setrlimit(RLIMIT_STACK, &stack) != 0 || setrlimit(RLIMIT_AS, &memory) != 0)
            _exit(3);
        visits v = {.failing = {ITEMS, ITEMS}};
        const aur_parallel_options options = {.threads = 16};
        int missing = aur_parallel_for(&options, ITEMS, visit, &v, NULL) != AUR_OK;
        for (size_t i = 0; i < ITEMS; ++i)
            missing |= atomic_load(&v.count[i]) != 1;
        _exit(missing);
    }
    assert_true(child > 0);
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

typedef struct nest {
    atomic_size_t inner_items, calls;
} nest;

static aur_result count_inner(void *context, size_t index) {
    (void)index;
    atomic_fetch_add(&((nest *)context)->inner_items, 1);
    return AUR_OK;
}

static aur_result work_inside(void *context, size_t index) {
    (void)index;
    const aur_parallel_options options = {.threads = 3};
    return aur_parallel_for(&options, 10, count_inner, context, NULL);
}

static int work_in_callback(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)what;
    (void)done;
    (void)total;
    nest *const n = user;
    atomic_fetch_add(&n->calls, 1);
    const aur_progress silent = {.function = NULL};
    const aur_parallel_options options = {.threads = 3, .progress = silent};
    return aur_parallel_for(&options, 10, count_inner, n, NULL) != AUR_OK;
}

/* A progress callback that called the library waited for itself for ever. */
static void nests_in_items_and_callbacks(void **state) {
    (void)state;
    alarm(60);
    nest n = {0};
    const aur_parallel_options options = {.threads = 3, .progress = {work_in_callback, &n}};
    assert_int_equal(aur_parallel_for(&options, 20, work_inside, &n, NULL), AUR_OK);
    assert_int_equal(atomic_load(&n.calls), 20);
    assert_int_equal(atomic_load(&n.inner_items), 20 * 10 + 20 * 10);
    alarm(0);
}

/* Nested callbacks of parallel work, all with long items that poll for cancellation. */
typedef struct depth {
    struct depth *inner;
    int cancels_at; /* calls of its callback; 0: never */
    atomic_int calls, stopped;
    aur_result inner_result;
} depth;

static aur_result check_often(void *context, size_t index) {
    (void)index;
    depth *const d = context;
    for (int i = 0; i < 3; ++i)
        if (aur_parallel_stops()) {
            atomic_fetch_add(&d->stopped, 1);
            return AUR_ERROR_CANCELLED;
        }
    return AUR_OK;
}

static int work_deeper(void *user, const char *what, uint64_t done, uint64_t total);

static aur_result work_at(depth *d) {
    const aur_parallel_options options = {
        .threads = 2, .progress = {work_deeper, d}, .flush_denormals = true};
    return aur_parallel_for(&options, 4, check_often, d, NULL);
}

static int work_deeper(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)what;
    (void)done;
    (void)total;
    depth *const d = user;
    volatile double smallest = 0x1p-1022;
    assert_true(smallest * 0.5 > 0.0);
    if (d->inner != NULL)
        d->inner_result = work_at(d->inner);
    return atomic_fetch_add(&d->calls, 1) + 1 == d->cancels_at;
}

static void nests_at_any_depth(void **state) {
    (void)state;
    alarm(60);
    depth last = {.cancels_at = 0}, middle = {.inner = &last}, first = {.inner = &middle};
    assert_int_equal(work_at(&first), AUR_OK);
    const int calls = 4 * 3 + 4; /* of one piece of work */
    assert_int_equal(atomic_load(&first.calls), calls);
    assert_int_equal(atomic_load(&middle.calls), calls * calls);
    assert_int_equal(atomic_load(&last.calls), calls * calls * calls);
    alarm(0);
}

/* A callback cancels only its own work, neither its caller's nor its callees'. */
static void cancels_one_depth(void **state) {
    (void)state;
    alarm(60);
    depth last = {.cancels_at = 0}, middle = {.inner = &last, .cancels_at = 2}, first = {.inner = &middle};
    const depth *const all[] = {&first, &middle, &last};
    assert_int_equal(work_at(&first), AUR_OK);
    assert_true(atomic_load(&middle.stopped) > 0);
    assert_int_equal(atomic_load(&first.stopped) + atomic_load(&last.stopped), 0);
    for (size_t i = 0; i < 3; ++i)
        assert_int_equal(all[i]->inner_result, AUR_OK);
    depth inner = {.cancels_at = 1}, outer = {.inner = &inner, .cancels_at = 3};
    assert_int_equal(work_at(&outer), AUR_ERROR_CANCELLED);
    assert_int_equal(outer.inner_result, AUR_OK); /* its only stop was the first time */
    assert_int_equal(atomic_load(&outer.calls), 3);
    alarm(0);
}

static pthread_barrier_t meeting;

static int meet(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)user;
    (void)what;
    (void)done;
    (void)total;
    pthread_barrier_wait(&meeting);
    return 0;
}

static aur_result nothing(void *context, size_t index) {
    (void)context;
    (void)index;
    return AUR_OK;
}

static void *report_once(void *unused) {
    const aur_parallel_options options = {.threads = 1, .progress = {meet, NULL}};
    aur_parallel_for(&options, 1, nothing, NULL, NULL);
    return unused;
}

/* The callbacks of two independent pieces of work wait for each other here; behind one lock they never met.
 */
static void independent_callbacks_run_at_once(void **state) {
    (void)state;
    alarm(60);
    pthread_barrier_init(&meeting, NULL, 2);
    pthread_t other;
    assert_int_equal(pthread_create(&other, NULL, report_once, NULL), 0);
    report_once(NULL);
    pthread_join(other, NULL);
    pthread_barrier_destroy(&meeting);
    alarm(0);
}

static int cancel_at_ten(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)user;
    (void)what;
    assert_true(total == ITEMS);
    return done >= 10;
}

static void cancels(void **state) {
    (void)state;
    visits v = {.failing = {ITEMS, ITEMS}};
    const aur_parallel_options options = {.threads = 1, .progress = {cancel_at_ten, NULL}};
    aur_error error;
    assert_int_equal(aur_parallel_for(&options, ITEMS, visit, &v, &error), AUR_ERROR_CANCELLED);
    assert_string_equal(error.message, "cancelled");
    assert_int_equal(atomic_load(&v.count[9]), 1);
    assert_int_equal(atomic_load(&v.count[10]), 0);
}

static aur_result halve(void *context, size_t index) {
    double *const products = context;
    volatile double smallest = 0x1p-1022;
    products[index] = smallest * 0.5;
    return AUR_OK;
}

/* Inside an item denormals are as they are outside, unless rays are traced; afterwards they are as they were.
 */
static void denormals_are_the_same_inside(void **state) {
    (void)state;
    double outside[1], inside[4], flushed[4];
    halve(outside, 0);
    assert_true(outside[0] > 0.0);
    const aur_parallel_options plain = {.threads = 2}, rays = {.threads = 2, .flush_denormals = true};
    assert_int_equal(aur_parallel_for(&plain, 4, halve, inside, NULL), AUR_OK);
    assert_int_equal(aur_parallel_for(&rays, 4, halve, flushed, NULL), AUR_OK);
    for (size_t i = 0; i < 4; ++i) {
        assert_true(inside[i] == outside[0]);
#if defined(__x86_64__) || defined(__aarch64__)
        assert_true(flushed[i] == 0.0);
#endif
    }
    halve(outside, 0);
    assert_true(outside[0] > 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(does_each_item_once),
        cmocka_unit_test(returns_the_first_failure),
        cmocka_unit_test(clamps_the_number_of_threads),
        cmocka_unit_test(works_without_threads_to_be_had),
        cmocka_unit_test(nests_in_items_and_callbacks),
        cmocka_unit_test(nests_at_any_depth),
        cmocka_unit_test(cancels_one_depth),
        cmocka_unit_test(independent_callbacks_run_at_once),
        cmocka_unit_test(cancels),
        cmocka_unit_test(denormals_are_the_same_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
