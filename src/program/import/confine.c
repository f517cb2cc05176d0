#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* syscall */
#endif
#include "program/import/writer.h"

#include <signal.h>
#include <stddef.h>
#include <sys/resource.h>
#include <unistd.h>

#if defined(__linux__)
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#if defined(__x86_64__)
#define ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#endif
#endif

#if defined(ARCHITECTURE)
/* The allowed system calls: memory, the socket, time and exit. All others fail with EPERM. */
static const unsigned allowed[] = {
    __NR_read,          __NR_write,       __NR_close,       __NR_mmap,         __NR_munmap,
    __NR_mremap,        __NR_mprotect,    __NR_madvise,     __NR_brk,          __NR_futex,
    __NR_clock_gettime, __NR_getpid,      __NR_gettid,      __NR_rt_sigaction, __NR_rt_sigprocmask,
    __NR_rt_sigreturn,  __NR_sigaltstack, __NR_sched_yield, __NR_exit,         __NR_exit_group};

enum { ALLOWED = sizeof allowed / sizeof allowed[0] };

static void filter_calls(void) {
    struct sock_filter code[2 * ALLOWED + 5];
    size_t n = 0;
    code[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, arch));
    code[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, ARCHITECTURE, 1, 0);
    code[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL);
    code[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr));
    for (size_t i = 0; i < ALLOWED; ++i) {
        code[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, allowed[i], 0, 1);
        code[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    }
    code[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | 1 /* EPERM */);
    const struct sock_fprog program = {.len = (unsigned short)n, .filter = code};
    /* Without seccomp filters in the kernel, only the resource limits apply. */
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0)
        (void)prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}
#endif

static void close_files(void) {
    enum { FIRST = 3, MOST = 65536 };
#if defined(SYS_close_range)
    if (syscall(SYS_close_range, FIRST, ~0u, 0) == 0)
        return;
#endif
    const long most = sysconf(_SC_OPEN_MAX);
    for (int i = FIRST; i < MOST && (most < 0 || i < most); ++i)
        close(i);
}

static void forbid(int what, rlim_t most) {
    const struct rlimit limit = {most, most};
    (void)setrlimit(what, &limit);
}

void confine_self(long parent) {
#if defined(__linux__)
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    if ((long)getppid() != parent) /* the parent has already ended */
        _exit(1);
    close_files();
    forbid(RLIMIT_NOFILE, 3); /* only open descriptors */
    forbid(RLIMIT_FSIZE, 0);
    forbid(RLIMIT_CORE, 0);
#if defined(ARCHITECTURE)
    filter_calls();
#endif
}
