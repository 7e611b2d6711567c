// SPDX-License-Identifier: Apache-2.0
// A plug-in for access control of somebody who does not obey: his own DDS lets him make every reader and writer. Whether he is heard then is up to the others,
// and that is what secure_test.py looks at. Everything else is Debian's plug-in, whose path is in SECURE_PEER_AC.
#include <dlfcn.h>
#include <stdlib.h>

#include "dds/security/dds_security_api.h"

static DDS_Security_boolean any_endpoint(dds_security_access_control* instance, const DDS_Security_PermissionsHandle permissions, const DDS_Security_DomainId domain,
                                         const char* topic, const DDS_Security_Qos* qos, const DDS_Security_PartitionQosPolicy* partition,
                                         const DDS_Security_DataTags* tags, DDS_Security_SecurityException* exception) {
  (void)instance, (void)permissions, (void)domain, (void)topic, (void)qos, (void)partition, (void)tags, (void)exception;
  return 1;
}

static DDS_Security_boolean any_topic(dds_security_access_control* instance, const DDS_Security_PermissionsHandle permissions, const DDS_Security_DomainId domain,
                                      const char* topic, const DDS_Security_Qos* qos, DDS_Security_SecurityException* exception) {
  (void)instance, (void)permissions, (void)domain, (void)topic, (void)qos, (void)exception;
  return 1;
}

typedef int (*init_function)(const char* argument, void** context, struct ddsi_domaingv* gv);
typedef int (*finalize_function)(void* context);

static void* real(const char* name) {
  void* library = dlopen(getenv("SECURE_PEER_AC"), RTLD_NOW);
  return library == NULL ? NULL : dlsym(library, name);
}

int init_access_control(const char* argument, void** context, struct ddsi_domaingv* gv);
int init_access_control(const char* argument, void** context, struct ddsi_domaingv* gv) {
  const init_function init = (init_function)real("init_access_control");
  const int result = init == NULL ? 1 : init(argument, context, gv);
  if (result != 0) return result;
  dds_security_access_control* plugin = *context;
  plugin->check_create_datawriter = any_endpoint;
  plugin->check_create_datareader = any_endpoint;
  plugin->check_create_topic = any_topic;
  return 0;
}

int finalize_access_control(void* context);
int finalize_access_control(void* context) {
  const finalize_function finalize = (finalize_function)real("finalize_access_control");
  return finalize == NULL ? 1 : finalize(context);
}
