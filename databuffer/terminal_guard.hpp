// Standard output and standard error without control characters: what a file, a packet or an argument has in it cannot
// drive the terminal of whoever reads it, nor a log of what was printed.
#pragma once

namespace yars::databuffer {

// From here on all that this process prints, by stdio or iostream, goes through failure::printable_lines. Call it first
// in main; a second call does nothing.
void guard_terminal();

}  // namespace yars::databuffer
