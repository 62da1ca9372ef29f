// Marks what libyars-radar offers. Everything else in the library is hidden.
// SPDX-License-Identifier: MIT
#pragma once

#define YARS_EXPORT __attribute__((visibility("default")))
