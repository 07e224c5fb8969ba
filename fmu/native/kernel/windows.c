/* What a library for Windows needs if it is linked without the start files of a C compiler.

   ziglang would first compile all of them, for minutes. Windows itself has the C library, and this
   is what lies between: a start that does nothing, by the names that linkers look for, the one
   function that is no export of it, and the toucher of the stack.
   Left out of builds by any other compiler, where CK_BARE_WINDOWS is not defined. */

#ifdef CK_BARE_WINDOWS

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

int DllMainCRTStartup(void *library, unsigned reason, void *reserved);
int _DllMainCRTStartup(void *library, unsigned reason, void *reserved);
int __stdio_common_vsprintf(uint64_t options, char *to, size_t size, const char *format,
                            void *locale, va_list words);
int snprintf(char *to, size_t size, const char *format, ...);

enum { AS_IN_C99 = 2 }; /* ends with a zero, and counts what did not fit */

int DllMainCRTStartup(void *library, unsigned reason, void *reserved) {
    (void)library, (void)reason, (void)reserved;
    return 1;
}

int _DllMainCRTStartup(void *library, unsigned reason, void *reserved) {
    return DllMainCRTStartup(library, reason, reserved);
}

int snprintf(char *to, size_t size, const char *format, ...) {
    va_list words;
    int written;
    va_start(words, format);
    written = __stdio_common_vsprintf(AS_IN_C99, to, size, format, NULL, words);
    va_end(words);
    return written;
}

/* Compilers call it where a function wants more than a page of stack, with the size in rax: pages
   are there only if touched one after the other. It must keep every register. */
__asm__(".globl ___chkstk_ms\n"
        "___chkstk_ms:\n"
        "  pushq %rax\n"
        "  pushq %rcx\n"
        "  leaq 24(%rsp), %rcx\n"
        "1:\n"
        "  subq $4096, %rcx\n"
        "  testb %cl, (%rcx)\n"
        "  subq $4096, %rax\n"
        "  ja 1b\n"
        "  popq %rcx\n"
        "  popq %rax\n"
        "  ret\n");

#else
typedef int ck_no_file_is_empty;
#endif
