// Makes one system call of a program fail, as a full or broken disk would. To be loaded by LD_PRELOAD.
// FAIL_CALL: open, write, fsync, rename, ftruncate or close; FAIL_AT: the how manieth of them fails (0: none);
// FAIL_ERRNO: with this error. Calls that concern files opened for writing are counted, in the process FAIL_PROGRAM
// only. Their number is written to the file FAIL_COUNT at exit.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static long calls;
static char written[4096];  // by descriptor: whether it was opened for writing

static int fails(const char* call) {
  const char *wanted = getenv("FAIL_CALL"), *program = getenv("FAIL_PROGRAM");
  if (!wanted || !program || strcmp(wanted, call) != 0 || strcmp(program, program_invocation_short_name) != 0) return 0;
  if (__atomic_add_fetch(&calls, 1, __ATOMIC_SEQ_CST) != atol(getenv("FAIL_AT"))) return 0;
  errno = atoi(getenv("FAIL_ERRNO"));
  return 1;
}

static int to_file(int fd) { return fd > 2 && fd < (int)sizeof written && written[fd]; }
static int writes(int flags) { return (flags & O_ACCMODE) != O_RDONLY; }
static int opened(int fd, int writing) {
  if (fd >= 0 && fd < (int)sizeof written) written[fd] = (char)writing;
  return fd;
}

__attribute__((destructor)) static void report(void) {
  const char *path = getenv("FAIL_COUNT"), *program = getenv("FAIL_PROGRAM");
  if (!path || !program || strcmp(program, program_invocation_short_name) != 0) return;
  FILE* file = REAL(fopen)(path, "w");
  if (file) fprintf(file, "%ld\n", calls), fclose(file);
}

#define MODE(flags)                           \
  unsigned mode = 0;                          \
  if ((flags) & (O_CREAT | O_TMPFILE)) {      \
    va_list more;                             \
    va_start(more, flags);                    \
    mode = va_arg(more, unsigned);            \
    va_end(more);                             \
  }

int open(const char* path, int flags, ...) {
  MODE(flags)
  return writes(flags) && fails("open") ? -1 : opened(REAL(open)(path, flags, mode), writes(flags));
}
int open64(const char* path, int flags, ...) {
  MODE(flags)
  return writes(flags) && fails("open") ? -1 : opened(REAL(open)(path, flags, mode), writes(flags));
}
int openat(int folder, const char* path, int flags, ...) {
  MODE(flags)
  return writes(flags) && fails("open") ? -1 : opened(REAL(openat)(folder, path, flags, mode), writes(flags));
}
FILE* fopen(const char* path, const char* mode) {
  const int writing = strpbrk(mode, "wa+") != NULL;
  if (writing && fails("open")) return NULL;
  FILE* file = REAL(fopen)(path, mode);
  if (file) opened(fileno(file), writing);
  return file;
}
FILE* fopen64(const char* path, const char* mode) { return fopen(path, mode); }

ssize_t write(int fd, const void* data, size_t size) {
  return to_file(fd) && fails("write") ? -1 : REAL(write)(fd, data, size);
}
ssize_t writev(int fd, const struct iovec* parts, int count) {
  return to_file(fd) && fails("write") ? -1 : REAL(writev)(fd, parts, count);
}
ssize_t pwrite(int fd, const void* data, size_t size, off_t at) {
  return to_file(fd) && fails("write") ? -1 : REAL(pwrite)(fd, data, size, at);
}
ssize_t pwrite64(int fd, const void* data, size_t size, off64_t at) {
  return to_file(fd) && fails("write") ? -1 : REAL(pwrite64)(fd, data, size, at);
}
int fsync(int fd) { return fails("fsync") ? -1 : REAL(fsync)(fd); }
int fdatasync(int fd) { return fails("fsync") ? -1 : REAL(fdatasync)(fd); }
int rename(const char* from, const char* to) { return fails("rename") ? -1 : REAL(rename)(from, to); }
int ftruncate(int fd, off_t size) { return to_file(fd) && fails("ftruncate") ? -1 : REAL(ftruncate)(fd, size); }
int ftruncate64(int fd, off64_t size) { return to_file(fd) && fails("ftruncate") ? -1 : REAL(ftruncate64)(fd, size); }
int close(int fd) {
  const int fail = to_file(fd) && fails("close"), reason = errno;
  opened(fd, 0);
  const int code = REAL(close)(fd);
  if (!fail) return code;
  errno = reason;
  return -1;
}
