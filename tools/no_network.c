/* Stands in for libcurl and libcrypto where HDF5's driver for files on servers is all that needs them (tools/carry.py). The driver
 * calls curl_global_init first, and gives up when that fails; the rest is never called. */
#include <stdlib.h>

int curl_global_init(long flags) {
  (void)flags;
  return 2; /* CURLE_FAILED_INIT */
}

#define NEVER_CALLED(name) \
  void name(void) { abort(); }
NEVER_CALLED(curl_global_cleanup)
NEVER_CALLED(curl_easy_init)
NEVER_CALLED(curl_easy_setopt)
NEVER_CALLED(curl_easy_perform)
NEVER_CALLED(curl_easy_cleanup)
NEVER_CALLED(curl_slist_append)
NEVER_CALLED(curl_slist_free_all)
NEVER_CALLED(EVP_sha256)
NEVER_CALLED(HMAC)
NEVER_CALLED(SHA256)
