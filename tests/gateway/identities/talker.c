// A foreign DDS program for the test of identities: writes or reads one topic.
// usage: talker write|read TOPIC PARTITION SECONDS
// Output: "received N"; "refused: REASON" and code 3 when the participant, writer or reader is not allowed.
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <word.h>  // made by idlc

static dds_entity_t allowed(const char* what, dds_entity_t entity) {
  if (entity >= 0) return entity;
  printf("refused: %s: %s\n", what, dds_strretcode(-entity));
  exit(3);
}

static double now_s(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const int writes = strcmp(argv[1], "write") == 0;
  const char* partition = argv[3];
  const dds_entity_t participant = allowed("participant", dds_create_participant(DDS_DOMAIN_DEFAULT, NULL, NULL));
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_partition(qos, 1, &partition);
  dds_entity_t above =
      writes ? dds_create_publisher(participant, qos, NULL) : dds_create_subscriber(participant, qos, NULL);
  const dds_entity_t topic = allowed("topic", dds_create_topic(participant, &yars_Word_desc, argv[2], NULL, NULL));
  const dds_entity_t end = writes ? allowed("writer", dds_create_writer(above, topic, qos, NULL))
                                  : allowed("reader", dds_create_reader(above, topic, qos, NULL));
  long received = 0;
  yars_Word word = {0};
  const struct timespec pause = {0, 20000000};
  for (const double until = now_s() + atof(argv[4]); now_s() < until; nanosleep(&pause, NULL)) {
    if (writes) {
      word.number++;
      dds_write(end, &word);
      continue;
    }
    void* one = &word;
    dds_sample_info_t info;
    while (dds_take(end, &one, &info, 1, 1) > 0) received += info.valid_data;
    // An answer is enough: a reader does not wait out its time.
    if (received >= 10) break;
  }
  printf("received %ld\n", received);
  dds_delete_qos(qos);
  dds_delete(participant);
  return 0;
}
