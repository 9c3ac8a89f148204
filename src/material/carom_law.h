/* Laws of your own for Carom, in a library apart: plain C, see docs/user_laws.md.

   A library exports carom_laws(). Units are those of the case, whatever they are. Functions are called from several
   threads at once and for one point several times: the same input must give the same output, nothing may be kept, no
   exception may leave them. */
#ifndef CAROM_LAW_H
#define CAROM_LAW_H

#ifdef __cplusplus
extern "C" {
#endif

/* Counts up when anything below changes; a library made for another one is refused. */
#define CAROM_LAW_INTERFACE 1

/* Small strain eps and Cauchy stress, or Green-Lagrange strain E = (F^T F - 1) / 2 and second Piola-Kirchhoff stress S.
   The latter is all that an objective law can see of F; where the law is written with the Cauchy stress or others, S is
   J F^-1 sigma F^-T, with F = U, the root of 1 + 2 E. */
/* NOLINTBEGIN(readability-identifier-naming): names of C, with a prefix of their own */
enum { CAROM_SMALL_STRAIN = 0, CAROM_GREEN_LAGRANGE = 1 };

/* A number that the user gives in the case file. */
typedef struct carom_law_parameter {
  const char* key;
  const char* meaning; /* one sentence */
  const char* unit;    /* "stress", "rate", ...: a row of the last table of docs/case_format.md; "": none */
  double low, high;    /* the range; -INFINITY and INFINITY: none */
  int is_closed_low, is_closed_high;
  double initial; /* its value where it is not given; NAN: it must be */
} carom_law_parameter;

/* Points of a batch of cells, structure of arrays: component c of n of point p, lane l stands at [(n p + c) lanes + l];
   n is 6 for strain and stress, the number of history variables for both histories, 1 for the rest. Order xx, yy, zz,
   xy, yz, zx; shear strains are 2 eps_ij. `lanes` is 1, 2, 4 or 8. */
typedef struct carom_law_points {
  int points, lanes;
  const double* parameters; /* in the order of carom_law.parameters */
  double rho;               /* density of the reference configuration */
  double dt;                /* length of the step */
  const double* strain;     /* at the end of the step */
  const double* history;    /* at its beginning; all 0 at rest */
  int is_over;              /* not 0: the history is that of the end already, nothing flows any more */
  double* stress;           /* at the end of the step */
  /* Each of these may be null: then it is not wanted. */
  double* energy;       /* stored, per reference volume: the derivative of it is the elastic part of the stress */
  double* dissipation;  /* lost since the start, per reference volume, a function of the history at the end */
  double* new_history;  /* at the end of the step; never the place of `history` */
  double* wave_modulus; /* at least the largest rho c^2 of waves, c in current lengths per time: explicit steps */
  /* Only where cells have hourglass modes that are to flow with their point, which a law that leaves these alone does
     without: the modes stay elastic. yield_stress: the equivalent stress of slow flow at the beginning of the step.
     mode_square: the square by which the modes raise the equivalent trial stress. share: what is left of the trial
     deviator. */
  double* yield_stress;
  const double* mode_square;
  double* share;
} carom_law_points;

/* Changes of the stress with changes of the strain at the end of a step: the consistent tangent. It must be symmetric.
 */
typedef struct carom_law_changes {
  int points, lanes;
  const double* parameters;
  double rho;
  double dt;
  const double* strain;
  const double* history;
  const double* strain_change;
  double* stress_change;
  /* As in carom_law_points, null where there are none: half the change of mode_square; the changes of the modes' forces
     are `share` times those of the trial ones and `along` times the trial ones. */
  const double* mode_square;
  const double* half_change;
  double* share;
  double* along;
} carom_law_changes;

typedef struct carom_law {
  const char* name;
  const char* summary; /* a phrase: "the law of Mooney and Rivlin, for rubber" */
  const char* formula; /* with its source; for pages */
  int measure;
  int parameter_count;
  const carom_law_parameter* parameters;
  int history_count;          /* at most CAROM_LAW_MOST_HISTORY */
  const char* const* history; /* names of the variables, which outputs have too */
  /* Young's modulus and Poisson's ratio of small changes at rest, of an isotropic body near to it where it is none:
     stiffness of contact, hourglass control, first stable step. */
  void (*at_rest)(const double* parameters, double* E, double* nu);
  /* What is wrong about values that are each in their range, as a sentence, or null. The function may be null. */
  const char* (*check)(const double* parameters);
  void (*update)(const carom_law_points* batch);
  /* Null: the law has none. Then it takes explicit schemes alone, and no plane stress and no bars. */
  void (*tangent)(const carom_law_changes* batch);
} carom_law;

#define CAROM_LAW_MOST_HISTORY 64

typedef struct carom_law_library {
  int interface_version; /* CAROM_LAW_INTERFACE */
  const char* version;   /* of the library, for its users */
  int law_count;
  const carom_law* laws;
} carom_law_library;

/* What a library exports. */
#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
const carom_law_library*
carom_laws(void);

/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
