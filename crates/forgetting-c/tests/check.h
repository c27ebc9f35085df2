/* What the tests are written with: each check counts, and a failure says where. */
#ifndef CHECK_H
#define CHECK_H

#include <stdio.h>

static int passed, failed;

#define CHECK(what)                                                        \
    do {                                                                   \
        if (what) {                                                        \
            ++passed;                                                      \
        } else {                                                           \
            ++failed;                                                      \
            fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #what);     \
        }                                                                  \
    } while (0)

static inline int verdict(const char *name) {
    printf("%s: %d passed, %d failed\n", name, passed, failed);
    return failed != 0;
}

#endif
