"""The C kernel of native FMUs: sources only; `native_build` compiles and packs them."""
