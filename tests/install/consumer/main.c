/* SPDX-License-Identifier: Apache-2.0 */
/* The smallest user of an installed libnc: prints its version and the memory that a default control needs. */
#include <nc/nc.h>
#include <stdio.h>

int main(void) {
  nc_config config;
  nc_config_init(&config);
  size_t bytes = nc_memory_required(&config);
  printf("%s %zu\n", nc_version(), bytes);
  return bytes > 0 ? 0 : 1;
}
