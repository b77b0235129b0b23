/* tests/lib/fence.h: memory between two pages that may not be touched. */
#ifndef LOBE_TESTS_LIB_FENCE_H
#define LOBE_TESTS_LIB_FENCE_H

#include <stddef.h>
#include <sys/mman.h>
#include <unistd.h>

/* The forbidden page touches the first byte, or the last. */
typedef enum fence_side { FENCE_BEFORE, FENCE_BEHIND } fence_side;

enum { FENCE_MOST = 64 };
static void *fence_pages[FENCE_MOST];
static int fence_count;

/* At most a page, which is the test's until fence_free_all. */
static inline void *fence_alloc(size_t size, fence_side side) {
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    assert_true(size <= page && fence_count < FENCE_MOST);
    char *memory = mmap(NULL, 3 * page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(memory != MAP_FAILED);
    assert_int_equal(mprotect(memory + page, page, PROT_READ | PROT_WRITE), 0);
    fence_pages[fence_count++] = memory;
    return memory + page + (side == FENCE_BEHIND ? page - size : 0);
}

static inline void fence_free_all(void) {
    while (fence_count > 0) munmap(fence_pages[--fence_count], 3 * (size_t)sysconf(_SC_PAGESIZE));
}

#endif
