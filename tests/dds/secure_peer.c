// SPDX-License-Identifier: Apache-2.0
// A program in C as others write them: it joins a domain with DDS Security, or without, reads the status of a control, gives commands and asks for services.
// secure_test.py and secure_services_test.py start it. It uses the types of the IDL and Cyclone DDS, and nothing of this tree.
//
//   secure_peer DOMAIN PARTITION PLUGINS IDENTITY [read] [command] [service=NAME]
//
// PLUGINS: folder of the plug-ins. IDENTITY: folder that nc-keys has made; "-" = without security.
// read: prints each status. command: sends what standard input says, one line each: SEQ KIND NUMBER VALUE.
// service: makes writers of all requests for services, and sends in this name what standard input says: TOPIC NUMBER SERVICE ARGUMENTS.
// It ends with standard input. Each line on standard output is an event; "t" is the monotonic time in milliseconds.
#define _POSIX_C_SOURCE 200809L
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "dds/dds.h"
#include "nc_dds.h"

static const char kNetwork[] =
    "<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>";

static double now_ms(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec * 1e3 + (double)t.tv_nsec / 1e6;
}

static void set(dds_qos_t* qos, const char* name, const char* before, const char* folder, const char* file) {
  char value[1024];
  snprintf(value, sizeof value, "%s%s/%s", before, folder, file);
  dds_qset_prop(qos, name, value);
}

static void secure(dds_qos_t* qos, const char* plugins, const char* identity) {
  set(qos, "dds.sec.auth.library.path", "", plugins, "libdds_security_auth.so");
  dds_qset_prop(qos, "dds.sec.auth.library.init", "init_authentication");
  dds_qset_prop(qos, "dds.sec.auth.library.finalize", "finalize_authentication");
  set(qos, "dds.sec.access.library.path", "", plugins, "libdds_security_ac.so");
  dds_qset_prop(qos, "dds.sec.access.library.init", "init_access_control");
  dds_qset_prop(qos, "dds.sec.access.library.finalize", "finalize_access_control");
  set(qos, "dds.sec.crypto.library.path", "", plugins, "libdds_security_crypto.so");
  dds_qset_prop(qos, "dds.sec.crypto.library.init", "init_crypto");
  dds_qset_prop(qos, "dds.sec.crypto.library.finalize", "finalize_crypto");
  set(qos, "dds.sec.auth.identity_ca", "file:", identity, "identity-ca.pem");
  set(qos, "dds.sec.auth.identity_certificate", "file:", identity, "identity.pem");
  set(qos, "dds.sec.auth.private_key", "file:", identity, "key.pem");
  set(qos, "dds.sec.access.permissions_ca", "file:", identity, "permissions-ca.pem");
  set(qos, "dds.sec.access.governance", "file:", identity, "governance.p7s");
  set(qos, "dds.sec.access.permissions", "file:", identity, "permissions.p7s");
}

// A reader or writer of a topic; on failure the event is "refused TOPIC REASON".
static dds_entity_t endpoint(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name, const char* partition, int writer,
                             int keep_last) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(500));
  if (keep_last) dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 64);
  else dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
  dds_qos_t* group_qos = dds_create_qos();
  dds_qset_partition1(group_qos, partition);
  const dds_entity_t topic = dds_create_topic(participant, type, name, NULL, NULL);
  dds_entity_t result = topic;
  if (topic > 0) {
    const dds_entity_t group = writer ? dds_create_publisher(participant, group_qos, NULL) : dds_create_subscriber(participant, group_qos, NULL);
    result = writer ? dds_create_writer(group, topic, qos, NULL) : dds_create_reader(group, topic, qos, NULL);
  }
  if (result < 0) printf("refused %s %s\n", name, dds_strretcode(result));
  else printf("made %s\n", name);
  dds_delete_qos(qos);
  dds_delete_qos(group_qos);
  return result;
}

static void print_status(dds_entity_t reader) {
  void* samples[16] = {NULL};
  dds_sample_info_t infos[16];
  const int count = dds_take(reader, samples, infos, 16, 16);
  for (int i = 0; i < count; ++i) {
    const nc_Status* status = samples[i];
    if (infos[i].valid_data)
      printf("status scan %llu feed %.3f t %.3f writer %llx\n", (unsigned long long)status->scan, status->feed_override, now_ms(),
             (unsigned long long)infos[i].publication_handle);
    else printf("status gone t %.3f\n", now_ms());
  }
  if (count > 0) dds_return_loan(reader, samples, count);
}

static void print_answers(dds_entity_t reader) {
  void* samples[16] = {NULL};
  dds_sample_info_t infos[16];
  const int count = dds_take(reader, samples, infos, 16, 16);
  for (int i = 0; i < count; ++i) {
    const nc_CommandAck* ack = samples[i];
    if (infos[i].valid_data)
      printf("answer %s %llu state %d reason %d repeated %d %s\n", ack->client, (unsigned long long)ack->seq, (int)ack->state, (int)ack->reason,
             (int)ack->repeated, ack->text);
  }
  if (count > 0) dds_return_loan(reader, samples, count);
}

static void send_line(dds_entity_t writer, const char* line) {
  unsigned long long seq = 0;
  int kind = 0;
  unsigned number = 0;
  double value = 0;
  if (sscanf(line, "%llu %d %u %lf", &seq, &kind, &number, &value) != 4) return;
  nc_Command command;
  memset(&command, 0, sizeof command);
  snprintf(command.client, sizeof command.client, "peer-%d", (int)getpid());
  command.seq = seq;
  command.kind = (nc_CommandKind)kind;
  command.lifespan_ms = 5000;
  command.lease_ms = 30000;
  command.expected_mode = -1;
  command.expected_run_state = -1;
  command.number = number;
  command.value = value;
  const dds_return_t result = dds_write(writer, &command);
  printf("sent %llu %s\n", seq, result < 0 ? dds_strretcode(result) : "ok");
}

#define REQUESTS 4
static const char* const kRequests[REQUESTS] = {"nc_ServiceView", "nc_ServiceOperate", "nc_ServiceSetUp", "nc_ServiceMaintain"};

// A client of the services; all is 0 where there is none, or it is refused.
static struct {
  const char* name;
  dds_entity_t replies, requests[REQUESTS];
  uint32_t heard[REQUESTS];
} client;

static void open_services(dds_entity_t participant, const char* partition, const char* name) {
  char own[256];
  snprintf(own, sizeof own, "%s/%s", partition, name);
  client.name = name;
  client.replies = endpoint(participant, &nc_ServiceReply_desc, "nc_ServiceReply", own, 0, 0);
  for (int i = 0; i < REQUESTS; ++i) client.requests[i] = endpoint(participant, &nc_ServiceRequest_desc, kRequests[i], partition, 1, 0);
}

static void print_heard(void) {
  for (int i = 0; i < REQUESTS; ++i) {
    dds_publication_matched_status_t matched;
    if (client.requests[i] <= 0 || dds_get_publication_matched_status(client.requests[i], &matched) < 0 || matched.current_count == client.heard[i]) continue;
    client.heard[i] = matched.current_count;
    printf("%s heard by %u\n", kRequests[i], client.heard[i]);
  }
}

static void ask(const char* line) {
  static nc_ServiceRequest request;
  char topic[32];
  unsigned long long number = 0;
  int begin = 0;
  memset(&request, 0, sizeof request);
  if (sscanf(line, "%31s %llu %31s %n", topic, &number, request.service, &begin) != 3) return;
  snprintf(request.client, sizeof request.client, "%s", client.name);
  snprintf(request.args, sizeof request.args, "%s", line + begin);
  request.number = number;
  for (int i = 0; i < REQUESTS; ++i)
    if (strcmp(topic, kRequests[i]) == 0 && client.requests[i] > 0)
      printf("sent %llu %s\n", number, dds_write(client.requests[i], &request) < 0 ? "failed" : "ok");
}

static void print_replies(void) {
  void* samples[16] = {NULL};
  dds_sample_info_t infos[16];
  const int count = dds_take(client.replies, samples, infos, 16, 16);
  for (int i = 0; i < count; ++i) {
    const nc_ServiceReply* reply = samples[i];
    if (infos[i].valid_data)
      printf("reply %llu status %d refusal \"%s\" session %llu part %u last %d t %.3f %s\n", (unsigned long long)reply->number, (int)reply->status, reply->refusal,
             (unsigned long long)reply->session, (unsigned)reply->part, (int)reply->last, now_ms(), reply->body);
  }
  if (count > 0) dds_return_loan(client.replies, samples, count);
}

int main(int argc, char** argv) {
  if (argc < 5) return 2;
  const unsigned domain = (unsigned)strtoul(argv[1], NULL, 10);
  int reads = 0, commands = 0;
  const char* service = NULL;
  for (int i = 5; i < argc; ++i) {
    reads |= strcmp(argv[i], "read") == 0;
    commands |= strcmp(argv[i], "command") == 0;
    if (strncmp(argv[i], "service=", 8) == 0) service = argv[i] + 8;
  }
  setvbuf(stdout, NULL, _IOLBF, 0);
  (void)dds_create_domain(domain, kNetwork);
  dds_qos_t* qos = dds_create_qos();
  if (strcmp(argv[4], "-") != 0) secure(qos, argv[3], argv[4]);
  const dds_entity_t participant = dds_create_participant(domain, qos, NULL);
  dds_delete_qos(qos);
  if (participant < 0) {
    printf("refused participant %s\n", dds_strretcode(participant));
    return 3;
  }
  printf("made participant\n");
  const dds_entity_t status = reads ? endpoint(participant, &nc_Status_desc, "nc_Status", argv[2], 0, 1) : 0;
  const dds_entity_t acks = commands ? endpoint(participant, &nc_CommandAck_desc, "nc_CommandAck", argv[2], 0, 0) : 0;
  const dds_entity_t command = commands ? endpoint(participant, &nc_Command_desc, "nc_Command", argv[2], 1, 0) : 0;
  if (service != NULL) open_services(participant, argv[2], service);
  static char text[65536];
  size_t length = 0;
  uint32_t heard = 0;
  for (;;) {
    struct pollfd in = {0, POLLIN, 0};
    if (poll(&in, 1, 2) > 0) {
      const ssize_t got = read(0, text + length, sizeof text - 1 - length);
      if (got <= 0) break;
      length += (size_t)got;
      text[length] = 0;
      char* end;
      while ((end = strchr(text, '\n')) != NULL) {
        *end = 0;
        if (command > 0) send_line(command, text);
        if (strncmp(text, "nc_Service", 10) == 0) ask(text);
        length -= (size_t)(end + 1 - text);
        memmove(text, end + 1, length + 1);
      }
    }
    if (status > 0) print_status(status);
    if (acks > 0) print_answers(acks);
    if (client.replies > 0) print_replies();
    print_heard();
    dds_publication_matched_status_t matched;
    if (command > 0 && dds_get_publication_matched_status(command, &matched) >= 0 && matched.current_count != heard) {
      heard = matched.current_count;
      printf("heard by %u\n", heard);
    }
  }
  dds_delete(DDS_CYCLONEDDS_HANDLE);
  return 0;
}
