// SPDX-License-Identifier: Apache-2.0
// Preloaded into a peer that deceives itself (secure_test.py): with SECURE_PEER_TRUSTS=1 it trusts its own permissions whoever has signed them, as somebody
// would who has signed them himself; its clock is SECURE_PEER_BEHIND seconds behind.
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <dlfcn.h>
#include <openssl/pkcs7.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static long number(const char* name) {
  const char* text = getenv(name);
  return text == NULL ? 0 : strtol(text, NULL, 10);
}

typedef int (*verify_function)(PKCS7*, STACK_OF(X509) *, X509_STORE*, BIO*, BIO*, int);

int PKCS7_verify(PKCS7* document, STACK_OF(X509) * certificates, X509_STORE* store, BIO* in, BIO* out, int flags) {
  const verify_function verify = (verify_function)dlsym(RTLD_NEXT, "PKCS7_verify");
  return verify(document, certificates, store, in, out, number("SECURE_PEER_TRUSTS") != 0 ? flags | PKCS7_NOVERIFY | PKCS7_NOSIGS : flags);
}

int clock_gettime(clockid_t clock, struct timespec* now) {
  const int result = (int)syscall(SYS_clock_gettime, clock, now);
  if (result == 0 && clock == CLOCK_REALTIME) now->tv_sec -= number("SECURE_PEER_BEHIND");
  return result;
}

time_t time(time_t* out) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (out != NULL) *out = now.tv_sec;
  return now.tv_sec;
}
