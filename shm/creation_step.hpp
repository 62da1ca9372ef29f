// The seam of the tests that kill a creator or a leaver after every single step: called, when set, behind each system
// call and each store by which a segment comes to be or goes. Nothing else uses it.
#pragma once

namespace yars::shm {

using CreationStep = void (*)(const char* what);
extern thread_local CreationStep creation_step;

}  // namespace yars::shm
