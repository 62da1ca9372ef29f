/* A program of somebody else: reads the sweeps of a session by DDS. It is made of the two .idl files alone.
 *
 * usage: foreign_sweeps PARTITION COUNT SECONDS     CYCLONEDDS_URI has the domain, interfaces, peers
 * Prints a line for each sweep. Exit code: 0 after COUNT sweeps, 1 if they did not come within SECONDS, 2 for a fault.
 */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <yars_network.h>

/* A reader of the topic, with the quality of service that docs/network.md states for sweeps. */
static dds_entity_t sweeps_of(dds_entity_t participant, const char* partition) {
  const char* partitions[] = {partition};
  dds_entity_t reader, subscriber, topic;
  dds_qos_t* quality = dds_create_qos();
  dds_qset_partition(quality, 1, partitions);
  dds_qset_reliability(quality, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(quality, DDS_DURABILITY_VOLATILE);
  dds_qset_history(quality, DDS_HISTORY_KEEP_LAST, 1024);
  topic = dds_create_topic(participant, &yars_net_SweepSample_desc, "yars/sweeps", NULL, NULL);
  subscriber = dds_create_subscriber(participant, quality, NULL);
  reader = dds_create_reader(subscriber, topic, quality, NULL);
  dds_delete_qos(quality);
  return reader;
}

static void print_sweep(const yars_net_SweepSample* sample) {
  unsigned sum = 0;
  uint32_t at;
  for (at = 0; at < sample->video._length; ++at) sum += sample->video._buffer[at];
  printf("sweep %u of tick %lld: %u samples, %s, sum %u, hash %016llx\n", (unsigned)sample->sweep.number,
         (long long)sample->sweep.tick, (unsigned)sample->video._length,
         sample->sweep.mode == yars_radar_Mode_rbm ? "rbm" : "other mode", sum, (unsigned long long)sample->sweep.hash);
}

int main(int count, char** words) {
  yars_net_SweepSample* sample;
  dds_entity_t participant, reader;
  dds_sample_info_t about;
  dds_time_t until;
  void* one = NULL;
  long wanted;
  if (count != 4) {
    fprintf(stderr, "usage: foreign_sweeps PARTITION COUNT SECONDS\n");
    return 2;
  }
  wanted = atol(words[2]);
  until = dds_time() + DDS_SECS(atol(words[3]));
  participant = dds_create_participant(DDS_DOMAIN_DEFAULT, NULL, NULL);
  reader = participant < 0 ? participant : sweeps_of(participant, words[1]);
  if (reader < 0) {
    fprintf(stderr, "foreign_sweeps: %s\n", dds_strretcode(-reader));
    return 2;
  }
  one = sample = yars_net_SweepSample__alloc();
  while (wanted > 0 && dds_time() < until) {
    if (dds_take(reader, &one, &about, 1, 1) == 1 && about.valid_data) {
      print_sweep(sample);
      --wanted;
    } else {
      dds_sleepfor(DDS_MSECS(1));
    }
  }
  yars_net_SweepSample_free(sample, DDS_FREE_ALL);
  dds_delete(participant);
  return wanted > 0;
}
