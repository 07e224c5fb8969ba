/* What a drive is made of: coil (coil.c), voltage over time, rough faces (faces.c).

   Conventions and laws are those of models/injector/valve.py: SI units; the gap grows as the
   valve opens. */

#ifndef CK_DRIVE_H
#define CK_DRIVE_H

#include "description.h"

/* An electromagnet with two poles: `pole` is inductance times length of air [H.m], `knee` the flux
   linkage [Wb] at which the iron resists twice as much. */
typedef struct {
    double resistance, pole, air_gap, iron_gap, knee;
} ck_coil;

/* Voltage [V] over time [s]; `cycles` is a whole number. */
typedef struct {
    double delay, period, on_time, boost_time, boost, hold, off, cycles;
} ck_profile;

typedef struct {
    ck_coil coil;
    ck_profile profile;
    double spring, preload;                  /* stiffness [N/m], force at h = 0 [N] */
    double stop_gap, stop_stiffness, damping; /* of the end stop */
} ck_drive;

/* A force with its slope, and the approach of the faces it belongs to. */
typedef struct {
    double force, slope, approach;
} ck_pressed;

double ck_coil_current(const ck_coil *coil, double flux, double gap);
double ck_coil_current_by_gap(const ck_coil *coil, double flux, double gap);
double ck_coil_force(const ck_coil *coil, double flux);

/* Take a flux along a gap that moves at one speed, under one voltage. `budget` is how many steps
   may still be taken. How far it got [s]: `duration`, if it did not fail. */
double ck_coil_advance(const ck_coil *coil, double *flux, double gap, double speed, double voltage,
                       double duration, long *budget);

/* Areas of contact and of plastic flow, and the branch of the load-displacement curve. */
typedef struct {
    double area, plastic;
    int branch;
} ck_touching;

ck_touching ck_faces_touching(const ck_faces *faces, const ck_pressed *pressed, double largest);
/* Force and its slope at an approach, after a largest one. */
double ck_faces_force(const ck_faces *faces, double approach, double largest, double *slope);
double ck_faces_residual(const ck_faces *faces, double largest);
double ck_faces_dissipated(const ck_faces *faces, double largest);

/* Faces in series with a spring, 0 is rigid; both approach by this since they touched. */
ck_pressed ck_faces_pressed(const ck_faces *faces, double approach, double largest,
                            double stiffness);

#endif
