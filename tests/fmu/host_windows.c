/* What a program for Windows needs if it is linked without the start files of a C compiler, which
   ziglang would first compile for minutes. Beside it goes fmu/native/kernel/windows.c. */

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int _configure_narrow_argv(int mode);
int main(int count, char **words);
void mainCRTStartup(void);
void __main(void);

void __main(void) {} /* nothing to set up before main */

void mainCRTStartup(void) {
    int status;
    _configure_narrow_argv(1);
    status = main(*__p___argc(), *__p___argv());
    fflush(NULL);
    exit(status);
}

int fprintf(FILE *to, const char *format, ...) {
    va_list words;
    int written;
    va_start(words, format);
    written = __stdio_common_vfprintf(2, to, format, NULL, words);
    va_end(words);
    return written;
}

int printf(const char *format, ...) {
    va_list words;
    int written;
    va_start(words, format);
    written = __stdio_common_vfprintf(2, stdout, format, NULL, words);
    va_end(words);
    return written;
}
