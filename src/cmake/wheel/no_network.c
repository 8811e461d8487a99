// HDF5 as Debian builds it also reads files from Amazon's S3, by libcurl and OpenSSL, which bring two dozen libraries
// more: six megabytes that somebody would have to keep safe, and that Stillpoint never calls. In a wheel HDF5 finds
// these in their place, by which S3 fails as it does without a network. no_network.map has the versions that it wants.
#define FAILS(function) \
  int function(void) { return 2; /* CURLE_FAILED_INIT */ }
#define GIVES_NOTHING(function) \
  void* function(void) { return 0; }

FAILS(curl_global_init)
FAILS(curl_global_cleanup)
GIVES_NOTHING(curl_easy_init)
FAILS(curl_easy_setopt)
FAILS(curl_easy_perform)
FAILS(curl_easy_cleanup)
GIVES_NOTHING(curl_slist_append)
FAILS(curl_slist_free_all)
GIVES_NOTHING(EVP_sha256)
GIVES_NOTHING(HMAC)
GIVES_NOTHING(SHA256)
