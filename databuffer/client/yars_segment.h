/* Part of yars.h, which includes this file: the mapped segment of a session, atomic words, the container LatestValue,
 * and byte locks. docs/shared_memory.md describes the segment. Programs include yars.h.
 */
#ifndef YARS_SEGMENT_H
#define YARS_SEGMENT_H

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#ifndef CLOCK_MONOTONIC
#error "include yars.h before any system header, or compile with -D_GNU_SOURCE"
#endif

#ifndef F_OFD_SETLK
#define F_OFD_GETLK 36
#define F_OFD_SETLK 37
#endif

#include "yars_records.h"

/* "YARSSHM1", the first word of a segment. */
#define YARS_MAGIC UINT64_C(0x314d485353524159)

/* ---- The session ---- */
typedef struct {
  int descriptor;                        /* of the segment's file; its open file description owns the byte locks */
  unsigned char* memory;                 /* the mapped segment; NULL: not attached */
  int ownship_lane, input_lane, process; /* index of the claimed lane or process table entry; -1: none */
  int traffic;                           /* 1: this program has claimed the traffic role */
  uint32_t events;                       /* number of events pushed */
  char path[96];
  char error[256]; /* reason of the last failure */
} yars_session;

/* Writes "WHAT: WHY" to s->error and returns -1. */
static inline int yars_fail(yars_session* s, const char* what, const char* why) {
  snprintf(s->error, sizeof s->error, "%s: %s", what, why);
  return -1;
}

/* The word at the offset `at` [bytes] of the segment. */
static inline uint64_t* yars_word(const yars_session* s, size_t at) {
  return (uint64_t*)(void*)(s->memory + at);
}

static inline uint64_t yars_load(const uint64_t* word) {
  return __atomic_load_n(word, __ATOMIC_ACQUIRE);
}

static inline void yars_store(uint64_t* word, uint64_t value) {
  __atomic_store_n(word, value, __ATOMIC_RELEASE);
}

static inline void yars_store_words(uint64_t* words, const void* record, size_t bytes) {
  for (size_t i = 0; i < bytes / 8; ++i) {
    uint64_t word;
    memcpy(&word, (const char*)record + 8 * i, 8);
    yars_store(&words[i], word);
  }
}

static inline void yars_load_words(const uint64_t* words, void* record, size_t bytes) {
  for (size_t i = 0; i < bytes / 8; ++i) {
    const uint64_t word = yars_load(&words[i]);
    memcpy((char*)record + 8 * i, &word, 8);
  }
}

/* ---- LatestValue: a state word in its own cache line, then four slots. A slot has sequence, version, record words.
 * Protocol: docs/shared_memory.md. `value_at`: offset of the container [bytes]. `bytes`: size of the record. ---- */
#define YARS_LINE ((size_t)64)
#define YARS_SLOTS 4
#define YARS_SLOT_STRIDE(bytes) (((bytes) + 16 + YARS_LINE - 1) / YARS_LINE * YARS_LINE)
#define YARS_VALUE_SIZE(bytes) (YARS_LINE + YARS_SLOTS * YARS_SLOT_STRIDE(bytes))

static inline uint64_t* yars_slot(const yars_session* s, size_t value_at, uint64_t version, size_t bytes) {
  return yars_word(s, value_at + YARS_LINE + (size_t)(version % YARS_SLOTS) * YARS_SLOT_STRIDE(bytes));
}

/* Version of the next value. After the greatest version comes 1, because 0 means never written. */
static inline uint64_t yars_next_version(const uint64_t* state) {
  const uint64_t version = yars_load(state) >> 1;
  return version == UINT64_MAX >> 1 ? 1 : version + 1;
}

/* Writes a new value. Only one thread at a time may write to a container. */
static inline void yars_publish(const yars_session* s, size_t value_at, const void* record, size_t bytes) {
  uint64_t* state = yars_word(s, value_at);
  const uint64_t version = yars_next_version(state);
  uint64_t* slot = yars_slot(s, value_at, version, bytes);
  const uint64_t odd = (yars_load(slot) + 1) | 1;
  yars_store(slot, odd);
  yars_store(slot + 1, version);
  yars_store_words(slot + 2, record, bytes);
  yars_store(slot, odd + 1);
  yars_store(state, version << 1 | 1);
}

/* Removes the value: readers find none until the next yars_publish(). */
static inline void yars_withdraw(const yars_session* s, size_t value_at) {
  uint64_t* state = yars_word(s, value_at);
  yars_store(state, yars_next_version(state) << 1);
}

/* Copies the last value to `record` and returns 1. Returns 0 if there is no value, or if the writer changed it during
 * each of 9 attempts; `record` is then unspecified. */
static inline int yars_read(const yars_session* s, size_t value_at, void* record, size_t bytes) {
  for (int attempt = 0; attempt < 9; ++attempt) {
    const uint64_t state = yars_load(yars_word(s, value_at));
    if ((state & 1) == 0) return 0;
    const uint64_t* slot = yars_slot(s, value_at, state >> 1, bytes);
    const uint64_t before = yars_load(slot);
    if (before % 2 != 0 || yars_load(slot + 1) != state >> 1) continue;
    yars_load_words(slot + 2, record, bytes);
    if (yars_load(slot) == before) return 1;
  }
  return 0;
}

/* ---- Locks on bytes of the segment's file. Each open() makes an open file description, which owns its locks. ---- */
/* `kind`: F_RDLCK, F_WRLCK or F_UNLCK. Returns 0, or -1 if another open file description has a conflicting lock. */
static inline int yars_lock(const yars_session* s, int byte, short kind) {
  struct flock lock;
  memset(&lock, 0, sizeof lock);
  lock.l_type = kind;
  lock.l_whence = SEEK_SET;
  lock.l_start = byte;
  lock.l_len = 1;
  return fcntl(s->descriptor, F_OFD_SETLK, &lock) == 0 ? 0 : -1;
}

/* Writes the pid of the holder into the header of the segment, for messages. */
static inline void yars_set_holder(const yars_session* s, int byte, int32_t pid) {
  __atomic_store_n((int32_t*)(void*)(s->memory + 32) + byte, pid, __ATOMIC_RELEASE);
}

/* Claims the first free one of the `count` bytes from `first_byte`. Returns its index among these bytes; -1: none is
 * free. */
static inline int yars_claim(const yars_session* s, int first_byte, int count) {
  for (int i = 0; i < count; ++i)
    if (yars_lock(s, first_byte + i, F_WRLCK) == 0) {
      yars_set_holder(s, first_byte + i, (int32_t)getpid());
      return i;
    }
  return -1;
}

static inline void yars_release(const yars_session* s, int byte) {
  yars_set_holder(s, byte, 0);
  yars_lock(s, byte, F_UNLCK);
}

/* True if another open file description, of this or another process, holds a lock on the byte. */
static inline int yars_is_held(const yars_session* s, int byte) {
  struct flock lock;
  memset(&lock, 0, sizeof lock);
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = byte;
  lock.l_len = 1;
  return fcntl(s->descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

#endif
