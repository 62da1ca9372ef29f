# Equal bits everywhere: no contraction into fused multiply-add, and never -ffast-math.
add_compile_options(-ffp-contract=off -fno-math-errno)
add_compile_options(-Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion)
if(YARS_WERROR)
  add_compile_options(-Werror)
endif()
