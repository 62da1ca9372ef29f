/* Records and numbers of the segment, for yars.h, which includes it: layout version, offsets, lock bytes, structures.
 * Units, ranges and senses stand at the fields; values of enumerations and bits in docs/shared_memory.md#values.
 * Made by databuffer/messages/generate.py from records.idl and `yars status --layout`: change those, not this. */
#ifndef YARS_RECORDS_H
#define YARS_RECORDS_H

/* clang-format off */
#include <stdint.h>

/* What this header was made for. */
#define YARS_LAYOUT_VERSION UINT32_C(3)
#define YARS_LAYOUT_SIZE UINT64_C(27471872)
#define YARS_LAYOUT_HASH UINT64_C(0xeb33f49407411935)

/* Offsets [bytes] from the segment's begin. */
#define YARS_AT_CLOCK 448
#define YARS_AT_OWNSHIP_PRIORITY 1024
#define YARS_AT_OWNSHIP 1088
#define YARS_AT_NAV 4416
#define YARS_AT_RADAR_STATE 7744
#define YARS_AT_MODEL_STATUS 13440
#define YARS_AT_OUTPUTS 16320
#define YARS_AT_SWEEPS 543680
#define YARS_AT_INPUT 4934656
#define YARS_AT_PROCESSES 5051392
#define YARS_AT_TRAFFIC 13587584
#define YARS_AT_FRAMES 13840128

/* A picture of the display: its slot's id, words and pixels. */
#define YARS_FRAMES 3
#define YARS_FRAME_STRIDE 4194376
#define YARS_FRAME_WORDS 8
#define YARS_FRAME_PIXELS 72
#define YARS_MOST_FRAME_BYTES 4194304

/* The ring of sweeps: its count, then slots of sequence, words used, words. */
#define YARS_SWEEPS 1024
#define YARS_SWEEP_STRIDE 4288
#define YARS_MOST_SAMPLES 4096

/* Lock bytes of the file, and how many there are of a kind. */
#define YARS_RADAR_MODEL_BYTE 1
#define YARS_STATE_MACHINE_BYTE 2
#define YARS_TRAFFIC_BYTE 5
#define YARS_FIRST_OWNSHIP_BYTE 8
#define YARS_FIRST_INPUT_BYTE 16
#define YARS_FIRST_PROCESS_BYTE 32
#define YARS_OWNSHIP_LANES 4
#define YARS_INPUT_LANES 16
#define YARS_INPUT_DEPTH 128
#define YARS_PROCESSES 32

/* The greatest id of a picture; the latest base [ns] of the session's clock. */
#define YARS_LATEST_PICTURE_ID UINT64_C(9007199254740992)
#define YARS_LATEST_CLOCK_BASE_NS INT64_C(576460752303423488)

/* The session's clock: sim time [ns] = base + rate x (CLOCK_MONOTONIC - base), while it runs. */
typedef struct {
  int64_t base_sim_ns;       /* [ns] [0, 576460752303423488] */
  int64_t base_monotonic_ns; /* [ns] [0, 576460752303423488] */
  double rate;               /* [0, 10] */
  uint32_t running;          /* [0, 1] 1 runs, 0 frozen */
  uint32_t epoch;            /* raised by each reset or repositioning */
  /* The last repositioning. Without a latitude there was none, and the other fields hold anything. */
  double reposition_latitude_deg;  /* [deg] [-90, 90] NaN = none in this epoch */
  double reposition_longitude_deg; /* [deg] [-180, 180] */
  double reposition_altitude_m;    /* [m] [-1000, 200000] MSL */
  double reposition_heading_deg;   /* [deg] [0, 360] true */
  uint32_t followed; /* 1: the aircraft's source had jumped there by itself, and the epoch only tells of it */
  uint32_t reserved0;
  uint64_t reserved[3];
} yars_clock;

/* Where the aircraft is and how it moves: the truth (video is made from it), and in Nav what the navigators believe
 * (symbols are placed by it). Written by a flight model into one of four lanes. */
typedef struct {
  int64_t source_time_ns;    /* [ns] the source's own stamp: carried, not believed */
  double latitude_deg;       /* [deg] [-90, 90] WGS84 */
  double longitude_deg;      /* [deg] [-180, 180] WGS84 */
  double altitude_msl_m;     /* [m] [-1000, 200000] above mean sea level */
  double heading_deg;        /* [deg] [0, 360] true */
  double pitch_deg;          /* [deg] [-90, 90] nose up positive */
  double roll_deg;           /* [deg] [-180, 180] right wing down positive */
  double velocity_north_mps; /* [m/s] [-10000, 10000] over ground */
  double velocity_east_mps;  /* [m/s] [-10000, 10000] over ground */
  double velocity_down_mps;  /* [m/s] [-10000, 10000] over ground */
  double radar_altitude_m;   /* [m] [0, 200000] above ground; NaN = no radar altimeter */
  uint32_t epoch;            /* session epoch that the writer knew; a new one makes a jump legal */
  uint32_t flags;            /* OwnshipFlags */
  char source[16];           /* "route", "fixed", "csv", "jsbsim": for people */
  /* [s] [0, 1e10] into the source's own recording, for its successor; 0 = not told; no recording is longer than
   * three centuries */
  double flight_time_s;
  uint64_t reserved[3];
} yars_ownship;

/* What the navigators believe. */
typedef struct {
  int64_t source_time_ns;        /* [ns] the source's own stamp */
  double mission_latitude_deg;   /* [deg] [-90, 90] mission navigator */
  double mission_longitude_deg;  /* [deg] [-180, 180] */
  double ins_latitude_deg;       /* [deg] [-90, 90] inertial navigation system */
  double ins_longitude_deg;      /* [deg] [-180, 180] */
  double velocity_north_mps;     /* [m/s] [-10000, 10000] the navigator's */
  double velocity_east_mps;      /* [m/s] [-10000, 10000] the navigator's */
  double velocity_down_mps;      /* [m/s] [-10000, 10000] the navigator's */
  double magnetic_variation_deg; /* [deg] [-180, 180] east positive; NaN = use the configuration's */
  uint32_t epoch;
  uint32_t flags;                /* NavFlags */
  uint64_t reserved[6];
} yars_nav;

/* A ship or a vehicle. */
typedef struct {
  double latitude_deg;       /* [deg] [-90, 90] WGS84 */
  double longitude_deg;      /* [deg] [-180, 180] WGS84 */
  double velocity_north_mps; /* [m/s] [-10000, 10000] */
  double velocity_east_mps;  /* [m/s] [-10000, 10000] */
  double height_m;           /* [m] [0, 1000] of what returns, above the ground or water; no mast is higher */
  double cross_section_m2;   /* [m2] [0, 1e7] of its radar echo; no ship returns more */
  uint32_t id;               /* the source's own */
  uint32_t reserved0;
} yars_traffic_entity;

/* Surface traffic from outside: ships and vehicles that an instructor's station or a bridge knows of. The radar
 * shows them as moving targets. Between two records of the source an entity goes straight on at its velocity. All
 * entities of this moment; one that is not named any more is gone. A source that has said nothing for
 * kTrafficStaleAfter has none. */
typedef struct {
  int64_t tick;                     /* [tick] at which the radar model took it over; 0 on the way in */
  int64_t source_time_ns;           /* [ns] the source's own stamp: carried, not believed */
  uint32_t count;                   /* [0, 64] used entries */
  uint32_t epoch;                   /* session epoch that the writer knew */
  uint64_t reserved[5];
  yars_traffic_entity entities[64]; /* the first `count` are in use */
} yars_traffic;

/* What an argument, x, y and the text may be depends on the kind: input_event.cpp. */
typedef struct {
  int64_t session_time_ns; /* [ns] sim time when the source made it */
  int64_t monotonic_ns;    /* [ns] CLOCK_MONOTONIC when the source made it; latency is measured from it */
  double x;                /* TDC deflection right [-1, 1], or elevation [deg] */
  double y;                /* TDC deflection up [-1, 1] */
  uint16_t kind;           /* EventKind */
  int16_t argument;
  uint32_t number;         /* counts up per source; `yars inject` waits for its own */
  char text[16];           /* zero terminated */
} yars_input_event;

/* A sequence point on the display. */
typedef struct {
  double latitude_deg;  /* [deg] [-90, 90] */
  double longitude_deg; /* [deg] [-180, 180] */
  double elevation_m;   /* [m] [-12000, 10000] MSL; NaN = unknown */
  char name[8];         /* "2.01", zero terminated */
  uint8_t kind;         /* radar::PointKind */
  uint8_t selected;     /* [0, 1] 1: the selected sequence point */
  uint8_t reserved[6];
} yars_drawn_point;

/* What a navigator has wrong beside what its lane says: added to the lane's position and velocity. */
typedef struct {
  double north_m;            /* [m] [-20100000, 20100000] */
  double east_m;             /* [m] [-20100000, 20100000] */
  double velocity_north_mps; /* [m/s] [-10000, 10000] */
  double velocity_east_mps;  /* [m/s] [-10000, 10000] */
  double velocity_down_mps;  /* [m/s] [-10000, 10000] */
} yars_navigator_error;

/* What MARK stored. */
typedef struct {
  double latitude_deg;  /* [deg] [-90, 90] as the navigator in use has it */
  double longitude_deg; /* [deg] [-180, 180] */
  double elevation_m;   /* [m] [-12000, 10000] MSL; NaN = unknown */
  int64_t sim_time_ns;  /* [ns] */
} yars_mark;

/* The whole state of the state machine: what the pilot has set, what the legends say, and all that a restarted state
 * machine needs to go on. Written once a tick when it has changed. */
typedef struct {
  int64_t tick;                 /* [tick] [-1, 9007199254740992] tick of the last change */
  double range_nm;              /* [NM] [0, 10800] selected range */
  double scan_width_deg;        /* [deg] [0, 360] whole width */
  double antenna_elevation_deg; /* [deg] [-60, 60] commanded, against the horizon */
  /* The ground point under the cursor on the video: where it truly lies. Without kCursorValid it may be NaN. */
  double cursor_latitude_deg;  /* [deg] [-90, 90] */
  double cursor_longitude_deg; /* [deg] [-180, 180] */
  double cursor_elevation_m;   /* [m] [-12000, 10000] MSL; NaN = unknown */
  double cursor_bearing_deg;   /* [deg] [0, 360] magnetic, from the aircraft */
  double cursor_range_nm;      /* [NM] [0, 10800] ground range from the aircraft */
  double tdc_x;                /* [-1, 1] held deflection */
  double tdc_y;                /* [-1, 1] held deflection */
  double window_nm;            /* [NM] [0, 10800] 0 = blank */
  uint64_t events_applied;     /* since the session began */
  uint32_t epoch;
  uint32_t flags;              /* RadarFlags */
  uint32_t scan_restart;       /* counts up when the scan has to start anew (range, mode, width changed) */
  uint32_t boxed;              /* bit n: legend of PB n is boxed */
  uint8_t power;               /* radar::Power */
  uint8_t mode;                /* radar::Mode as shown (RBM, ..., MENU) */
  uint8_t master;              /* radar::Master */
  uint8_t resume_mode;         /* radar::Mode that runs; equal to mode but under the menu */
  uint8_t range_index;
  uint8_t scan;                /* radar::ScanWidth */
  uint8_t gain;                /* [0, 3] */
  uint8_t brightness;          /* [0, 15] */
  uint8_t contrast;            /* [0, 15] */
  uint8_t cursor_function;     /* radar::CursorFunction */
  uint8_t navigator;           /* radar::Navigator */
  uint8_t channel;             /* [1, 8] */
  uint8_t band;                /* [0, 4] A..E */
  uint8_t points_drawn;        /* [0, 8] entries of points */
  uint8_t window_index;        /* into the configuration's windows; 255 = blank */
  uint8_t recall;              /* radar::Recall */
  char sequence_point[8];      /* name of the selected one, zero terminated */
  char message[32];            /* for the pilot, zero terminated; empty = none */
  int64_t message_until_tick;  /* [tick] [-1, 9007199254740992] the message goes at this tick; kUntilCauseEnds */
  yars_drawn_point points[8];  /* the first `points_drawn` are in use */
  char legends[21][8];         /* [n]: legend of PB n, zero terminated, empty = none; [0] unused */
  /* Apex of the cursor's frame: the aircraft, or where it was when the picture froze. */
  double frame_latitude_deg;  /* [deg] [-90, 90] */
  double frame_longitude_deg; /* [deg] [-180, 180] */
  double frame_track_deg;     /* [deg] [0, 360] true ground track of that frame, up on the display */
  uint8_t ground_mode;        /* radar::Mode to go back to from A/A and ranging */
  uint8_t reserved_bytes[3];
  /* The map that the pilot commands. */
  uint32_t map_request;     /* counts up with every map that the pilot commands */
  double map_latitude_deg;  /* [deg] [-90, 90] centre of that map */
  double map_longitude_deg; /* [deg] [-180, 180] */
  double map_window_nm;     /* [NM] [0, 10800] its edge */
  /* Maps by id, 0 = none; the radar model reuses no slot that is named here. */
  uint64_t map_newest; /* [0, 9007199254740992] */
  uint64_t map_old;    /* [0, 9007199254740992] */
  uint64_t map_stored; /* [0, 9007199254740992] */
  uint64_t map_shown;  /* [0, 9007199254740992] */
  /* The cursor as the navigator in use has it: told to others. Without kCursorValid it may be NaN. */
  double cursor_believed_latitude_deg;  /* [deg] [-90, 90] */
  double cursor_believed_longitude_deg; /* [deg] [-180, 180] */
  yars_navigator_error mission;
  yars_navigator_error ins;
  /* UPDT: from the selected sequence point as the display shows it to the cursor. */
  double update_north_m;     /* [m] [-20100000, 20100000] */
  double update_east_m;      /* [m] [-20100000, 20100000] */
  int64_t cursor_moved_tick; /* [tick] [-1, 9007199254740992] when the cursor was last slewed or sent to a point */
  int32_t update_seconds;    /* [s] until the cursor's position is too old for an INS update; -1 = it does not age */
  uint32_t vtr_request;      /* counts up with PB 12: the recorder starts or stops writing */
  /* The designated target, and what leads to it. */
  double target_latitude_deg;  /* [deg] [-90, 90] as the navigator had it */
  double target_longitude_deg; /* [deg] [-180, 180] */
  double target_elevation_m;   /* [m] [-12000, 10000] MSL; NaN = unknown */
  char target_name[8];         /* "4.", "2.01", zero terminated */
  double steering_line_deg;    /* [deg] [0, 360] true heading of the pattern steering line, toward the target */
  double cue_latitude_deg;     /* [deg] [-90, 90] what the other sensor was last slaved to; holds while cue_count > 0 */
  double cue_longitude_deg;    /* [deg] [-180, 180] */
  double cue_elevation_m;      /* [m] [-12000, 10000] MSL; NaN = unknown */
  uint32_t cue_count;          /* counts up with CUE and TGT */
  uint32_t target_count;       /* counts up with TGT */
  uint8_t steering_line;       /* SteeringLine */
  uint8_t mark_count;          /* [0, 10] entries of marks; the oldest makes way */
  uint8_t reserved_bytes2[2];
  uint32_t velocity_taken;     /* ModelStatus::velocity_count that was last looked at */
  /* [tick] [-1, 9007199254740992] when the navigator's velocity was last put right; -1 = never */
  int64_t velocity_updated_tick;
  int64_t velocity_shown_until_tick; /* [tick] [-1, 9007199254740992] the differences of IPVU go at this tick */
  /* Velocity of the radar less that of the mission navigator. */
  double velocity_along_mps;    /* [m/s] [-10000, 10000] along the ground track */
  double velocity_across_mps;   /* [m/s] [-10000, 10000] to the right */
  double velocity_vertical_mps; /* [m/s] [-10000, 10000] up */
  yars_mark marks[10];          /* oldest first; the first `mark_count` are in use */
  /* [deg] [-180, 180] east positive: of the navigator, of the field's model, or configured */
  double magnetic_variation_deg;
  /* The ground whose elevation the model is to tell: a point that was designated, else the cursor's. */
  double asked_latitude_deg;  /* [deg] [-90, 90] on the video */
  double asked_longitude_deg; /* [deg] [-180, 180] */
  int64_t asked_tick;         /* [tick] [-1, 9007199254740992] when it was designated */
  uint32_t asked_for;         /* kAskedFor...; 0 = the cursor alone */
  uint32_t reserved_word;
  uint64_t reserved[3];
} yars_radar_state;

/* What the state machine tells the rest of the aircraft: sensors, weapons, head-up display. Points are as the
 * navigator in use has them. Written every tick, also with the radar off: a target forgotten has to be told. */
typedef struct {
  int64_t tick;        /* [tick] */
  int64_t sim_time_ns; /* [ns] */
  /* CUE and TGT: where another sensor shall look. */
  double cue_latitude_deg;  /* [deg] holds while cue_count > 0 */
  double cue_longitude_deg; /* [deg] */
  double cue_elevation_m;   /* [m] MSL; NaN = unknown */
  /* TGT */
  double target_latitude_deg;  /* [deg] holds while target_name is not empty */
  double target_longitude_deg; /* [deg] */
  double target_elevation_m;   /* [m] MSL; NaN = unknown */
  char target_name[8];         /* zero terminated; empty = none designated */
  /* Ranging to the target, from the aircraft. */
  double slant_range_m;  /* [m] NaN = no target */
  double bearing_deg;    /* [deg] [0, 360) true; NaN = no target */
  double depression_deg; /* [deg] below the horizon; NaN = no target */
  /* Steering to the target. */
  double steering_deg; /* [deg] azimuth: of the target, right of the ground track; bank: right wing down; NaN = none */
  double approach_deg; /* [deg] [0, 360) true heading of the pattern steering line; NaN = none */
  uint32_t epoch;
  uint32_t cue_count;  /* counts up with each cue */
  uint32_t target_count; /* counts up with each designation */
  uint8_t steering;      /* SteeringCommand */
  uint8_t mark_count;    /* [0, 10] entries of marks */
  uint8_t reserved_bytes[2];
  yars_mark marks[10];   /* oldest first; the first `mark_count` are in use */
  uint64_t reserved[8];
} yars_outputs;

/* What one position of the antenna returned, on the ground from the apex to range_m between the two azimuths. */
typedef struct {
  int64_t tick;               /* [tick] [0, 922337203685] */
  int64_t sim_time_ns;        /* [ns] [0, 4611686018427387904] */
  double apex_latitude_deg;   /* [deg] [-90, 90] where the aircraft was */
  double apex_longitude_deg;  /* [deg] [-180, 180] */
  double apex_altitude_msl_m; /* [m] [-1000, 200000] */
  double azimuth_left_deg;    /* [deg] [0, 360] true, counter-clockwise edge of the wedge */
  double azimuth_right_deg;   /* [deg] [0, 360] true, clockwise edge of the wedge */
  double ground_track_deg;    /* [deg] [0, 360] true, at the time */
  double elevation_deg;       /* [deg] [-90, 90] antenna, against the horizon */
  double range_m;             /* [m] [0, 20001600] ground range of the far end of the last sample */
  uint64_t hash;              /* XXH3 64 of the fields above but for the times, then of the used samples */
  uint32_t epoch;
  uint32_t scan;              /* number of the scan, counts up */
  uint32_t number;            /* of the sweep, counts up over all scans */
  uint32_t samples;           /* [0, 4096] used entries of video */
  uint32_t flags;             /* SweepFlags */
  uint8_t mode;               /* radar::Mode */
  uint8_t gain;               /* [0, 3] */
  uint8_t direction;          /* [0, 1] 1: clockwise, 0: counter-clockwise */
  uint8_t reserved0;
  uint64_t reserved[4];
  /* near to far; 0 black, 255 white; gain applied, brightness not; the first `samples` are in use */
  uint8_t video[4096];
} yars_sweep;

/* Published every tick. A restarted model resumes servo and scan number from it. */
typedef struct {
  int64_t tick;                     /* [tick] [0, 922337203685] */
  int64_t sim_time_ns;              /* [ns] [0, 4611686018427387904] */
  double antenna_azimuth_deg;       /* [deg] [-180, 180] against the nose, right positive; NaN = unknown */
  double antenna_elevation_deg;     /* [deg] [-90, 90] against the horizon; NaN = unknown */
  double height_above_ground_m;     /* [m] [-200000, 212000] below the aircraft; NaN = unknown */
  double ground_elevation_m;        /* [m] [-12000, 10000] MSL below the aircraft; NaN = unknown */
  double cursor_ground_elevation_m; /* [m] [-12000, 10000] MSL below the cursor; NaN = unknown */
  double map_timer_s;               /* [s] [0, 1e6] NaN = none */
  double map_progress;              /* [0, 1] NaN = none */
  double load;                      /* [0, 1e6] share of a core that the kernel took, smoothed */
  uint64_t terrain_generation;
  uint64_t terrain_bytes;           /* [bytes] */
  uint64_t sweeps;                  /* published since the session began */
  uint64_t late_ticks;              /* skipped */
  uint64_t refused;                 /* inputs refused by validation */
  uint64_t posts_pending;           /* look-ups that met a post still loading */
  uint32_t epoch;
  uint32_t scan;
  uint32_t sweep;
  uint32_t flags;                   /* ModelFlags */
  uint32_t scan_restart;            /* the last one obeyed */
  uint32_t ownship_lane;
  int8_t scan_direction;            /* [-1, 1] +1 clockwise, -1 counter-clockwise */
  uint8_t mode;                     /* radar::Mode */
  uint8_t scan_bar;
  uint8_t mappable;                 /* [0, 1] 1: a patch could be commanded at the cursor */
  char why_not[20];                 /* when not mappable: "BLIND ZONE", ... */
  char fidelity[16];
  yars_ownship ownship;             /* the one used, for those who draw and log */
  yars_nav nav;                     /* goes with it */
  /* What a restarted model, or a replay from the middle of a scan, needs to go on with the very next sweep. */
  double scan_centre_deg;  /* [deg] [-360, 360] true, at the end of the tick */
  double scan_width_deg;   /* [deg] [0, 360] of the scan under way */
  double scan_range_m;     /* [m] [0, 20001600] of the scan under way */
  uint32_t scan_tick;      /* [tick] within the scan */
  uint8_t antenna_phase;   /* [0, 4] antenna::Phase */
  uint8_t scan_noise_only; /* 1: SNIFF holds for the scan under way */
  uint8_t reserved0[2];
  /* [ns] [0, 4611686018427387904] sim time at which the ownship used came; staleness is judged by it */
  int64_t ownship_received_ns;
  /* The patch map under way: where it will lie; a window of 0 = none. Its time left is map_timer_s, its share
   * map_progress. */
  double map_latitude_deg;   /* [deg] [-90, 90] centre */
  double map_longitude_deg;  /* [deg] [-180, 180] */
  double map_up_deg;         /* [deg] [0, 360] true bearing that will point up */
  double map_window_nm;      /* [NM] [0, 10800] edge */
  uint64_t map_newest;       /* [0, 9007199254740992] id of the last map that was completed; 0 = none */
  uint32_t map_request;      /* the last request taken up */
  uint32_t map_done_request; /* the request that the last map answers */
  double scan_offset_deg;    /* [deg] [-360, 360] middle of the sector against the ground track */
  double scan_rate_dps;      /* [deg/s] [0, 10000] of the scan under way; 0: the configuration's */
  /* PVU and IPVU: the aircraft's velocity over ground as the radar last measured it. */
  double velocity_north_mps; /* [m/s] [-10000, 10000] */
  double velocity_east_mps;  /* [m/s] [-10000, 10000] */
  double velocity_down_mps;  /* [m/s] [-10000, 10000] */
  int64_t velocity_due_tick; /* [tick] [-1, 922337203685] IPVU: when the next measurement falls due; -1 = none */
  uint32_t velocity_count;   /* measurements completed since the session began */
  uint32_t velocity_dwell;   /* ticks that the beam under way has stood */
  uint8_t velocity_beam;     /* 1, 2, ... under way; 0 = none */
  uint8_t reserved_bytes[7];
  /* The ground that RadarState asked for. */
  double answered_latitude_deg;  /* [deg] [-90, 90] as asked */
  double answered_longitude_deg; /* [deg] [-180, 180] */
  double answered_elevation_m;   /* [m] [-12000, 10000] MSL; NaN = unknown */
  char map_stopped[16];          /* why the patch is not mapped again: "BLIND ZONE", ...; empty = it is */
  uint64_t reserved[3];
} yars_model_status;

/* What a picture of the display is: goes with the pixels of its slot. Rows from the top, without padding, 4 bytes a
 * pixel in the order red, green, blue, 255. */
typedef struct {
  uint64_t id;         /* [0, 9007199254740992] counts up over the session; 0 = none */
  int64_t tick;        /* [tick] of the radar state that is on it */
  int64_t sim_time_ns; /* [ns] when it was drawn */
  uint32_t width;      /* [pixels] [1, 1024] */
  uint32_t height;     /* [pixels] [1, 1024] */
  uint64_t reserved[4];
} yars_glass_frame;

#endif
