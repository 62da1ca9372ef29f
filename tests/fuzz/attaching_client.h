/* A program of one's own, by databuffer/client/yars.h: attaches, looks at everything, feeds, leaves. 1: it was let in.
 */
#ifndef YARS_TESTS_FUZZ_ATTACHING_CLIENT_H
#define YARS_TESTS_FUZZ_ATTACHING_CLIENT_H

#ifdef __cplusplus
extern "C"
#endif
    int
    attach_as_a_client(const char* session_name);

#endif
