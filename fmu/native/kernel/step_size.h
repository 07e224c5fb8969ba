/* Step-size control: numbers of numerics/step_size.py, for each method whose own they are not. */
#ifndef CK_STEP_SIZE_H
#define CK_STEP_SIZE_H

#define CK_SAFETY 0.9    /* of the length that would just meet the tolerance */
#define CK_SHRINK 0.1    /* at most, after a step whose error is too large */
#define CK_GROW 8.0      /* at most, from one step to the next */
#define CK_UNSOLVED 0.25 /* after a step that could not be solved at all */

#endif
