/* Forks before and after parallel work, threads that ask one handle, many handles at once. */
#include <dirent.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "delone.h"

enum { COUNT = 200000, PLACES = 50000, THREADS = 8 };

static double xy[2 * COUNT];

static int build(size_t count) {
    delone_points p = delone_xy(xy, count);
    delone_tri2 *t;
    if (delone_tri2_new(&p, &t, NULL) != 0) return 1;
    delone_tri2_free(t);
    return 0;
}

/* A child that hangs is ended by its alarm. */
static int in_child(void) {
    int status;
    pid_t child = fork();
    if (child == 0) {
        alarm(100);
        _exit(build(1000) || build(COUNT) || build(COUNT));
    }
    return waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0;
}

/* Threads for two and for three are made once, beside those of the pools before (64 and more would be one for each call). */
static int keeps_threads(void) {
    int i, count = 0;
    DIR *tasks;
    for (i = 0; i < 60; i++) {
        if (delone_set_threads(2 + i % 2, NULL) || build(COUNT / 4)) return 1;
    }
    tasks = opendir("/proc/self/task");
    while (tasks != NULL && readdir(tasks) != NULL) count++;
    if (tasks != NULL) closedir(tasks);
    return count > 64;
}

static const delone_tri2 *shared;
static int64_t expected[PLACES];

static void *ask(void *unused) {
    static const char wrong[] = "wrong";
    delone_points p = delone_xy(xy, PLACES);
    int64_t *rows = malloc(PLACES * sizeof *rows);
    size_t i;
    (void)unused;
    if (delone_tri2_nearest(shared, &p, 1, rows, NULL) != 0) return (void *)wrong;
    for (i = 0; i < PLACES; i++) {
        if (rows[i] != (int64_t)i) return (void *)wrong;
    }
    if (delone_tri2_locate(shared, &p, rows, NULL) != 0) return (void *)wrong;
    for (i = 0; i < PLACES; i++) {
        if (rows[i] != expected[i]) return (void *)wrong;
    }
    free(rows);
    return build(2000) ? (void *)wrong : NULL;
}

int main(void) {
    pthread_t threads[THREADS];
    delone_points p = delone_xy(xy, COUNT), places = delone_xy(xy, PLACES);
    delone_tri2 *t;
    size_t i;
    int wrong = 0;
    alarm(300);
    for (i = 0; i < 2 * COUNT; i++) xy[i] = rand() / (RAND_MAX + 1.0) + i * 1e-12;
    if (in_child()) return puts("a fork before the first call"), 1;
    if (build(COUNT) || in_child() || in_child()) return puts("a fork after parallel work"), 1;
    if (delone_set_threads(3, NULL) || build(COUNT) || in_child()) return puts("a fork with another pool"), 1;
    if (keeps_threads()) return puts("threads of other numbers"), 1;
    if (delone_tri2_new(&p, &t, NULL) || delone_tri2_locate(t, &places, expected, NULL)) return 1;
    shared = t;
    for (i = 0; i < THREADS; i++) wrong |= pthread_create(threads + i, NULL, ask, NULL);
    for (i = 0; i < THREADS; i++) {
        void *result;
        wrong |= pthread_join(threads[i], &result) || result != NULL;
    }
    delone_tri2_free(t);
    if (wrong) return puts("threads that ask one handle"), 1;
    puts("all is well");
    return 0;
}
