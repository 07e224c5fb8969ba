/* FMI 3.0: reading and writing variables, derivatives, and the state of an instance. */

#include "fmi3_own.h"

#include "saved.h"

/* Every variable is a scalar, so there are as many values as references. */
static int fit(ck_own *own, const void *vr, size_t n, const void *values, size_t m) {
    if (n == m && (n == 0 || (vr && values))) return 1;
    ck_own_fail(own, n != m ? "there must be as many values as value references; reset the FMU"
                            : "value references or values are missing; reset the FMU");
    return 0;
}

static int get(ck_own *own, fmi3ValueReference vr, int type, double *found) {
    if (type != CK_REAL || vr != (fmi3ValueReference)own->model.data.port_count + 1)
        return ck_model_get(&own->model, vr, type, found);
    *found = own->model.state.time; /* the variable that comes after all others */
    return CK_OK;
}

#define ACCESS(TYPE, OUR_TYPE)                                                                    \
    fmi3Status fmi3Get##TYPE(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,      \
                             fmi3##TYPE values[], size_t m) {                                     \
        size_t i;                                                                                 \
        OWN(instance);                                                                            \
        if (!fit(own, vr, n, values, m)) return fmi3Error;                                        \
        for (i = 0; i < n; i++) {                                                                 \
            double found;                                                                         \
            if (get(own, vr[i], OUR_TYPE, &found) != CK_OK) return fmi3Error;                     \
            values[i] = (fmi3##TYPE)found;                                                        \
        }                                                                                         \
        return fmi3OK;                                                                            \
    }                                                                                             \
    fmi3Status fmi3Set##TYPE(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,      \
                             const fmi3##TYPE values[], size_t m) {                               \
        size_t i;                                                                                 \
        OWN(instance);                                                                            \
        if (!fit(own, vr, n, values, m)) return fmi3Error;                                        \
        for (i = 0; i < n; i++)                                                                   \
            if (ck_model_set(&own->model, vr[i], OUR_TYPE, (double)values[i]) != CK_OK)           \
                return fmi3Error;                                                                 \
        return fmi3OK;                                                                            \
    }

ACCESS(Float64, CK_REAL)
ACCESS(Int32, CK_INTEGER)
ACCESS(Int64, CK_ENUMERATION) /* as the standard has it */
ACCESS(Boolean, CK_BOOLEAN)

/* Slopes -------------------------------------------------------------------------------------- */

static int fit_slopes(ck_own *own, const void *unknown, size_t n, const void *known, size_t m,
                      const void *seed, const void *found) {
    if ((n == 0 || unknown) && (m == 0 || known) && ((n == 0 && m == 0) || (seed && found))) return 1;
    ck_own_fail(own, "derivatives: arguments are missing; reset the FMU");
    return 0;
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknown[],
                                        size_t n, const fmi3ValueReference known[], size_t m,
                                        const fmi3Float64 seed[], size_t seeds,
                                        fmi3Float64 found[], size_t founds) {
    OWN(instance);
    if (!fit_slopes(own, unknown, n, known, m, seed, found)) return fmi3Error;
    if (seeds != m || founds != n)
        return ck_own_lacks(own, "getDirectionalDerivative: give a seed for each known and room "
                                 "for each unknown");
    return (fmi3Status)ck_model_derivative(&own->model, unknown, n, known, m, seed, found);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknown[],
                                    size_t n, const fmi3ValueReference known[], size_t m,
                                    const fmi3Float64 seed[], size_t seeds, fmi3Float64 found[],
                                    size_t founds) {
    static const double one = 1.0;
    size_t i, k;
    OWN(instance);
    if (!fit_slopes(own, unknown, n, known, m, seed, found)) return fmi3Error;
    if (seeds != n || founds != m)
        return ck_own_lacks(own, "getAdjointDerivative: give a seed for each unknown and room for "
                                 "each known");
    for (k = 0; k < m; k++) {
        double sum = 0.0, slope;
        for (i = 0; i < n; i++) {
            if (ck_model_derivative(&own->model, &unknown[i], 1, &known[k], 1, &one, &slope) != CK_OK)
                return fmi3Error;
            sum += seed[i] * slope;
        }
        found[k] = sum;
    }
    return fmi3OK;
}

/* The state ----------------------------------------------------------------------------------- */

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state) {
    OWN(instance);
    return (fmi3Status)ck_saved_take(&own->model, state);
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
    OWN(instance);
    return (fmi3Status)ck_saved_restore(&own->model, state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *state) {
    OWN(instance);
    return (fmi3Status)ck_saved_free(state);
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, size_t *size) {
    OWN(instance);
    return (fmi3Status)ck_saved_size(&own->model, state, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[],
                                 size_t size) {
    OWN(instance);
    return (fmi3Status)ck_saved_write(&own->model, state, bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], size_t size,
                                   fmi3FMUState *state) {
    OWN(instance);
    return (fmi3Status)ck_saved_read(&own->model, bytes, size, state);
}
