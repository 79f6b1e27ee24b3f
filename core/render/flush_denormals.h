// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <immintrin.h>

namespace tenniel {

// Denormals cost a hundredfold and mean nothing here. The threads are shared with Blender, so the
// mode is put back.
class FlushDenormals {
 public:
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }  // FTZ | DAZ
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

}  // namespace tenniel
