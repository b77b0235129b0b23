#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */

#include "child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

/* The address sanitizer reserves far more than any program uses. */
#if defined(__SANITIZE_ADDRESS__)
#define HAS_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HAS_ADDRESS_SANITIZER 1
#endif
#endif
#ifndef HAS_ADDRESS_SANITIZER
#define HAS_ADDRESS_SANITIZER 0
#endif

static const rlim_t MOST_MEMORY = (rlim_t)2 << 30;

void *lobe_shared_make(size_t size) {
    void *shared = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return shared != MAP_FAILED ? shared : NULL;
}

void lobe_shared_free(void *shared, size_t size) {
    if (shared != NULL) munmap(shared, size);
}

double lobe_child_clock(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void lobe_child_pause(void) {
    nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL);
}

/* A group of its own, so that what it starts ends with it; it does not outlive this process. */
static void confine(pid_t parent) {
    setpgid(0, 0);
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    if (getppid() != parent) _exit(0);
    struct rlimit none = {0, 0}, memory = {MOST_MEMORY, MOST_MEMORY};
    setrlimit(RLIMIT_CORE, &none);
    if (!HAS_ADDRESS_SANITIZER) setrlimit(RLIMIT_AS, &memory);
    int nothing = open("/dev/null", O_RDONLY);
    if (nothing >= 0) dup2(nothing, STDIN_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    for (int number = 1; number < 32; ++number) {
        if (number != SIGKILL && number != SIGSTOP) signal(number, SIG_DFL);
    }
}

int lobe_child_start(lobe_child *child, void (*work)(void *task), void *task, double seconds) {
    pid_t parent = getpid();
    pid_t pid = fork();
    if (pid < 0) return 0;
    if (pid == 0) {
        confine(parent);
        work(task);
        _exit(0);
    }
    setpgid(pid, pid); /* here too: whoever comes first */
    *child = (lobe_child){pid, lobe_child_clock() + seconds};
    return 1;
}

static void describe_end(int status, char *cause, size_t room) {
    *cause = '\0';
    if (WIFSIGNALED(status)) {
        snprintf(cause, room, "crashed (%s)", strsignal(WTERMSIG(status)));
    } else if (WIFEXITED(status) && WEXITSTATUS(status) != 0) {
        snprintf(cause, room, "exited with status %d", WEXITSTATUS(status));
    }
}

void lobe_child_end(lobe_child *child) {
    if (child->pid == 0) return;
    kill(-child->pid, SIGKILL);
    kill(child->pid, SIGKILL);
    while (waitpid(child->pid, NULL, 0) < 0 && errno == EINTR) continue;
    child->pid = 0;
}

int lobe_child_has_ended(lobe_child *child, char *cause, size_t room) {
    int status;
    pid_t ended = waitpid(child->pid, &status, WNOHANG);
    if (ended == child->pid) {
        describe_end(status, cause, room);
        kill(-child->pid, SIGKILL); /* what it may have started */
        child->pid = 0;
        return 1;
    }
    if (lobe_child_clock() < child->until) return 0;
    lobe_child_end(child);
    snprintf(cause, room, "ran out of time");
    return 1;
}
