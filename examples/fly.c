/* Example of a flight model in C. It attaches to a running set and publishes an aircraft until the set ends or
 * Ctrl-C. The aircraft flies circles about LAT LON [deg], by default off the Californian coast. The set needs no flight
 * model of its own (scripts/start --no-flight). If it has one, this program prevails: its priority is 50, the set's 10.
 *   cc -I. examples/fly.c -o fly -lm  &&  ./fly [SESSION [LAT LON]] */
#include "databuffer/client/yars.h"
/* The header defines feature macros and must come first. */
#include <math.h>
#include <signal.h>
#include <stdlib.h>

static volatile sig_atomic_t ended = 0;
static void end(int signal) {
  ended = signal;
}

int main(int argc, char** argv) {
  yars_session s;
  if (yars_attach(&s, argc > 1 ? argv[1] : "default", "fly.c") != 0 || yars_claim_ownship_lane(&s, 50) < 0) {
    fprintf(stderr, "%s\n", s.error);
    return 1;
  }
  signal(SIGINT, end);
  signal(SIGTERM, end);
  const double degree = 0.017453292519943295, radius_m = 8000.0, speed_mps = 200.0;
  const double latitude_deg = argc > 3 ? atof(argv[2]) : 36.5, longitude_deg = argc > 3 ? atof(argv[3]) : -122.3;
  const int64_t begin_ns = yars_monotonic_ns();
  while (!ended && yars_set_runs(&s)) {
    const double time_s = 1e-9 * (double)(yars_monotonic_ns() - begin_ns);
    const double angle = speed_mps / radius_m * time_s; /* [rad] on the circle, clockwise from north */
    yars_ownship o = {0};
    o.latitude_deg = latitude_deg + radius_m * cos(angle) / 111000.0; /* 111,000 m: one degree of latitude */
    o.longitude_deg = longitude_deg + radius_m * sin(angle) / (111000.0 * cos(latitude_deg * degree));
    o.altitude_msl_m = 4500.0;
    o.heading_deg = fmod(angle / degree + 90.0, 360.0);
    o.roll_deg = 27.0; /* right wing down: bank of a coordinated turn, atan(v^2 / (g r)) */
    o.velocity_north_mps = -speed_mps * sin(angle);
    o.velocity_east_mps = speed_mps * cos(angle);
    o.radar_altitude_m = NAN;
    o.epoch = yars_epoch(&s);
    strcpy(o.source, "fly.c");
    yars_publish_ownship(&s, &o);
    yars_heartbeat(&s);
    nanosleep(&(struct timespec){0, 20000000}, NULL);
  }
  yars_detach(&s);
  return 0;
}
