# Programs that an attacker finds harder to lead astray: guarded stacks, checked copies (FORTIFY), addresses that differ
# from run to run (PIE), tables of the linker that nobody can write (full RELRO), marked targets of jumps (CET).
# lab/measure_hardening tells what it costs. Sanitizers find more than FORTIFY does and do not go with it.
option(YARS_HARDENING "harden the programs of optimized builds" ${PROJECT_IS_TOP_LEVEL})
set(YARS_HARDENED OFF)
if(YARS_HARDENING AND CMAKE_BUILD_TYPE MATCHES "Rel" AND NOT "${CMAKE_CXX_FLAGS} ${CMAKE_C_FLAGS}" MATCHES "-fsanitize")
  set(YARS_HARDENED ON)
  include(CheckCXXCompilerFlag)
  add_compile_options(-fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
  check_cxx_compiler_flag(-fcf-protection YARS_HAS_CET)
  if(YARS_HAS_CET)
    add_compile_options(-fcf-protection)
  endif()
  add_link_options($<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-pie> -Wl,-z,relro -Wl,-z,now -Wl,-z,noexecstack)
endif()
