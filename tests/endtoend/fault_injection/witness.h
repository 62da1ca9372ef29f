/* Values that distinguish a complete record from a torn one. The last word of a record of fault_client is a checksum of
 * all other words. The pixels of its pictures follow from the picture's id, the deflections of its TDC events from the
 * event's number. fault_client (C) writes these values, watch (C++) checks them. */
#ifndef YARS_FAULT_WITNESS_H
#define YARS_FAULT_WITNESS_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define FAULT_SOURCE "fault"                    /* `source` of fault_client's ownship, prefix of its events' texts */
#define FAULT_FRAME_MARK UINT64_C(0x6d726f7473) /* first reserved word of fault_client's pictures and nav records */

/* Checksum of all 64-bit words of the record except the last. */
static inline uint64_t witness_sum(const void* record, size_t bytes) {
  uint64_t sum = UINT64_C(0xcbf29ce484222325);
  for (size_t i = 0; i + 1 < bytes / 8; ++i) {
    uint64_t word;
    memcpy(&word, (const char*)record + 8 * i, 8);
    sum = (sum ^ word) * UINT64_C(0x100000001b3);
    sum ^= sum >> 29;
  }
  return sum;
}

static inline void witness_sign(void* record, size_t bytes) {
  const uint64_t sum = witness_sum(record, bytes);
  memcpy((char*)record + bytes - 8, &sum, 8);
}

static inline int witness_is_whole(const void* record, size_t bytes) {
  const uint64_t sum = witness_sum(record, bytes);
  return memcmp((const char*)record + bytes - 8, &sum, 8) == 0;
}

/* Word `word` of picture `id`: two RGBA pixels with alpha 255, as in pictures of the display. */
static inline uint64_t witness_pixels(uint64_t id, size_t word) {
  return ((id * UINT64_C(0x9e3779b97f4a7c15)) ^ (uint64_t)word) | UINT64_C(0xff000000ff000000);
}

/* Deflections of the TDC of event `number`, in [-1, 1]. */
static inline double witness_tdc_x(uint32_t number) {
  return (double)(number % 2001) / 1000.0 - 1.0;
}
static inline double witness_tdc_y(uint32_t number) {
  return -witness_tdc_x(number);
}

#endif
