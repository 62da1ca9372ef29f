/* A client that uses databuffer/client/yars.h: attaches, reads records, publishes, detaches. Returns 1 if it could
 * attach, else 0. */
#ifndef YARS_TESTS_FUZZ_ATTACHING_CLIENT_H
#define YARS_TESTS_FUZZ_ATTACHING_CLIENT_H

#ifdef __cplusplus
extern "C"
#endif
    int
    attach_as_a_client(const char* session_name);

#endif
