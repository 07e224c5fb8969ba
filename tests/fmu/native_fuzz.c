/* Spoils the file of tables of an FMU in many ways, with a checksum that fits, and opens each:

   native_fuzz FOLDER_OF_RESOURCES SCRATCH_FOLDER COUNT       prints how many were taken for good

   The checksum is there to notice what happens to files; this is about what the reader trusts. */

#include "model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEAD 64 /* letters, checksum, count, GUID; then the numbers */

static int failures;
static unsigned long long chance = 88172645463325252ull;

static size_t below(size_t bound) {
    chance ^= chance << 13, chance ^= chance >> 7, chance ^= chance << 17;
    return (size_t)(chance % bound);
}

static void hear(void *host, int status, const char *category, const char *message) {
    (void)host, (void)status, (void)category;
    if (strlen(message) > 3000) failures++;
}

static void spoil(unsigned char *bytes, size_t *size, int way) {
    static const double odd[] = {NAN, INFINITY, -INFINITY, -1.0, 0.0, 0.5, 1e300, 1e-300, 2e9, -2e9,
                                 1e6, 7.0, 3.0, 2.0, 1.0, 64.0};
    size_t numbers = (*size - HEAD) / 8, place = way % 3 ? below(numbers) : below(400);
    unsigned long long sum, count = numbers;
    double value = odd[below(16)];
    if (place >= numbers) place = 0;
    if (way % 7 == 6) count = numbers - place - 1, *size = HEAD + (size_t)count * 8;
    else if (way % 7 == 5) bytes[HEAD + 8 * place + below(8)] ^= (unsigned char)(1u << below(8));
    else memcpy(bytes + HEAD + 8 * place, &value, 8);
    if (way % 11 == 10) count += below(5) - 2; /* and a count that does not fit */
    sum = ck_checksum(bytes + HEAD, *size - HEAD);
    memcpy(bytes + 8, &sum, 8), memcpy(bytes + 16, &count, 8);
}

/* What an instance does with tables that passed: outputs at the start, and one short step. */
static int use(const char *folder, const char *guid) {
    ck_model *model = (ck_model *)calloc(1, sizeof *model);
    int opened;
    unsigned reference;
    double value;
    model->say = hear;
    opened = ck_model_open(model, folder, guid);
    if (opened && model->state.values[CK_MAX_STEPS] <= 100000) {
        ck_model_setup(model, 0.0, NULL, NULL), ck_model_initialize(model);
        ck_model_set(model, 1, CK_REAL, 1e-5), ck_model_set(model, 2, CK_REAL, 1.0);
        ck_model_step(model, 0.0, 1e-12);
        for (reference = 1; reference <= CK_VARIABLES; reference++)
            if (ck_model_get(model, reference, CK_REAL, &value) == CK_OK && !isfinite(value)) {
                fprintf(stderr, "variable %u is %g\n", reference, value);
                failures++;
            }
    }
    ck_model_close(model);
    free(model);
    return opened;
}

int main(int count, char **words) {
    static unsigned char good[1 << 22], bytes[1 << 22];
    char path[2000], guid[41];
    size_t size;
    int i, taken = 0, tries = count == 4 ? atoi(words[3]) : 0;
    FILE *file;
    snprintf(path, sizeof path, "%s/film.bin", words[1]);
    file = fopen(path, "rb");
    if (!file) return 2;
    size = fread(good, 1, sizeof good, file);
    fclose(file);
    if (size < HEAD + 800 || size == sizeof good) return 3;
    memcpy(guid, good + 24, 40), guid[40] = 0;
    if (!use(words[1], guid)) return 4;
    for (i = 0; i < tries; i++) {
        size_t now = size;
        memcpy(bytes, good, size);
        spoil(bytes, &now, i);
        snprintf(path, sizeof path, "%s/film.bin", words[2]);
        file = fopen(path, "wb");
        if (!file || fwrite(bytes, 1, now, file) != now) return 5;
        fclose(file);
        taken += use(words[2], guid);
        if (failures) {
            fprintf(stderr, "after change %d\n", i);
            return 1;
        }
    }
    printf("%d\n", taken);
    return failures != 0;
}
