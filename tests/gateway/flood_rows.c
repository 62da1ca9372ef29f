/* A program of somebody else that floods a session by DDS: rows of patch maps that do not exist, each with a key of its
 * own.
 *
 * usage: flood_rows PARTITION SECONDS     CYCLONEDDS_URI has the domain, interfaces, peers
 * Writes about 6,000 rows a second. Exit code: 0 after SECONDS, 2 for a fault.
 */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <yars_network.h>

/* A writer of the topic, with the quality of service that docs/network.md states for patch rows. */
static dds_entity_t rows_of(dds_entity_t participant, const char* partition) {
  const char* partitions[] = {partition};
  dds_entity_t writer, publisher, topic;
  dds_qos_t* quality = dds_create_qos();
  dds_qset_partition(quality, 1, partitions);
  dds_qset_reliability(quality, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(quality, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(quality, DDS_HISTORY_KEEP_LAST, 1);
  topic = dds_create_topic(participant, &yars_net_PatchRowSample_desc, "yars/patch_rows", NULL, NULL);
  publisher = dds_create_publisher(participant, quality, NULL);
  writer = dds_create_writer(publisher, topic, quality, NULL);
  dds_delete_qos(quality);
  return writer;
}

int main(int count, char** words) {
  static yars_net_PatchRowSample row;
  dds_entity_t participant, writer;
  dds_time_t until;
  if (count != 3) {
    fprintf(stderr, "usage: flood_rows PARTITION SECONDS\n");
    return 2;
  }
  until = dds_time() + DDS_SECS(atol(words[2]));
  participant = dds_create_participant(DDS_DOMAIN_DEFAULT, NULL, NULL);
  writer = participant < 0 ? participant : rows_of(participant, words[1]);
  if (writer < 0) {
    fprintf(stderr, "flood_rows: %s\n", dds_strretcode(-writer));
    return 2;
  }
  row.length = 1000;
  for (; dds_time() < until; ++row.id) {
    row.number = row.id;
    dds_write(writer, &row);
    if (row.id % 12 == 0) dds_sleepfor(DDS_MSECS(2));
  }
  dds_delete(participant);
  return 0;
}
