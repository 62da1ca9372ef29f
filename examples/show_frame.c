/* Example of a reader of display frames in C. It attaches to a running set in which `radar-display --publish` runs. It
 * prints number, tick, sim time and size of each frame until Ctrl-C. With FILE.ppm it writes one frame and ends.
 *   cc -I. examples/show_frame.c -o show_frame  &&  ./show_frame [SESSION [FILE.ppm]] */
#include "databuffer/client/yars.h"
/* The header defines feature macros and must come first. */
#include <signal.h>
#include <stdlib.h>

static volatile sig_atomic_t ended = 0;
static void end(int signal) {
  ended = signal;
}

/* Writes a portable pixmap (binary PPM): a text header, then red, green and blue of each pixel. */
static int write_ppm(const char* path, const yars_glass_frame* frame, const unsigned char* pixels) {
  FILE* file = fopen(path, "wb");
  if (file == NULL) {
    perror(path);
    return 1;
  }
  fprintf(file, "P6\n# tick %lld\n%u %u\n255\n", (long long)frame->tick, (unsigned)frame->width,
          (unsigned)frame->height);
  for (size_t i = 0; i < (size_t)frame->width * frame->height; ++i) fwrite(pixels + 4 * i, 1, 3, file); /* RGBA */
  const int failed = ferror(file) != 0;
  if (fclose(file) == 0 && !failed) return 0;
  perror(path);
  return 1;
}

int main(int argc, char** argv) {
  yars_session s;
  if (yars_attach(&s, argc > 1 ? argv[1] : "default", "show_frame") != 0) {
    fprintf(stderr, "%s\n", s.error);
    return 1;
  }
  unsigned char* pixels = malloc(YARS_MOST_FRAME_BYTES);
  if (pixels == NULL) {
    yars_detach(&s);
    return 1;
  }
  signal(SIGINT, end);
  signal(SIGTERM, end);
  int result = 0;
  yars_glass_frame frame = {0};
  for (uint64_t shown = 0; !ended;) {
    yars_heartbeat(&s);
    if (yars_read_frame(&s, shown, &frame, pixels) == 0) {
      nanosleep(&(struct timespec){0, 5000000}, NULL);
      continue;
    }
    shown = frame.id;
    printf("%llu: tick %lld, %.3f s, %u x %u\n", (unsigned long long)frame.id, (long long)frame.tick,
           1e-9 * (double)frame.sim_time_ns, (unsigned)frame.width, (unsigned)frame.height);
    fflush(stdout);
    if (argc > 2) {
      result = write_ppm(argv[2], &frame, pixels);
      break;
    }
  }
  free(pixels);
  yars_detach(&s);
  return result;
}
