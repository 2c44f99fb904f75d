/* Cleave: kernels for particle-method simulation of impact and dynamic fracture.  The C interface.
 *
 * Two layers:
 *   array calls    no state; the caller owns all memory and gives an index range; safe to call
 *                  concurrently on disjoint ranges;
 *   model handle   opaque; owns particles, bonds and state; fields are reached by name.
 *
 * Rules that hold for every function
 *   - It returns a status (enum cleave_status).  On an error nothing else is returned, and
 *     cleave_last_message() of the same thread says what was given, what is allowed, what to do.
 *   - No exception, exit, print, signal handler or global state crosses this interface.
 *   - Counts and indices are int64_t, status and choices int32_t, reals double.
 *   - Ranges are 0-based and half-open: first <= i < last.  Indices of particles are 0-based.
 *   - Vectors are consecutive triples, v(3,n) in Fortran; in two dimensions the third component is
 *     present, ignored on input and zero on output.
 *   - Tensors are nine consecutive numbers 11 21 31 12 22 32 13 23 33, t(3,3,n) in Fortran, so that
 *     Fortran's t(i,j,n) is component ij.  First index of F: current, second: reference.  First
 * index of P: force direction, second: reference.
 *   - There is no unit system: any consistent set.  Dimensions are given in SI as [Pa].  In two
 *     dimensions volumes are areas, forces are per thickness.
 *   - Structs begin with their size; fill them with the init function, which sets the defaults.
 *   - Strings handed out as `const char*` live as long as the library.
 */
#ifndef CLEAVE_H
#define CLEAVE_H

#include <stdint.h>

#include "cleave/version.h"

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32)
#define CLEAVE_API
#else
#define CLEAVE_API __attribute__((visibility("default")))
#endif

/* Number of this interface; given to cleave_model_create or cleave_abi_check and checked there. */
#define CLEAVE_ABI_VERSION 2

enum cleave_status {
#define CLEAVE_STATUS(name, value, text) CLEAVE_##name = value,
#include "cleave/tables/status.def"
  CLEAVE_STATUS_END_ = 1000
};

enum cleave_material {
#define CLEAVE_MATERIAL(name, value, type, title, source) CLEAVE_MATERIAL_##name = value,
#include "cleave/tables/materials.def"
  CLEAVE_MATERIAL_END_ = 1000
};

enum cleave_formulation {
#define CLEAVE_FORMULATION(name, value, type, title, source) CLEAVE_FORMULATION_##name = value,
#include "cleave/tables/formulations.def"
  CLEAVE_FORMULATION_END_ = 1000
};

enum cleave_kinematics {
  CLEAVE_3D = 1,           /* tetrahedra */
  CLEAVE_PLANE_STRAIN = 2, /* triangles, F33 = 1 */
  CLEAVE_PLANE_STRESS = 3  /* triangles, P33 = 0 */
};

enum cleave_table {
  CLEAVE_TABLE_STATUS = 1,
  CLEAVE_TABLE_MATERIAL = 2,
  CLEAVE_TABLE_FORMULATION = 3,
  CLEAVE_TABLE_GROUP = 4 /* parameter groups of formulations: "fracture", "viscosity", ... */
};

enum cleave_type { CLEAVE_REAL = 1, CLEAVE_INTEGER = 2, CLEAVE_CHOICE = 3 };

enum cleave_relation {
  CLEAVE_RELATION_BODY = 1,      /* one value a body */
  CLEAVE_RELATION_POINT = 2,     /* a particle */
  CLEAVE_RELATION_BOND = 3,      /* an undirected bond */
  CLEAVE_RELATION_SIMPLEX = 4,   /* a triangle or tetrahedron */
  CLEAVE_RELATION_HALF_BOND = 5, /* a bond seen from one end: twice the bonds */
  /* A point where the stress is evaluated.  Where these are the particles themselves, a body's
   * fields say CLEAVE_RELATION_POINT; finite elements have their own, element by element. */
  CLEAVE_RELATION_INTEGRATION_POINT = 6
};

enum cleave_lifetime {
  CLEAVE_LIFETIME_SETUP = 1,   /* fixed after set-up */
  CLEAVE_LIFETIME_STATE = 2,   /* evolves */
  CLEAVE_LIFETIME_CACHE = 3,   /* recomputed from setup and state by cleave_model_restore */
  CLEAVE_LIFETIME_SCRATCH = 4, /* meaningless between steps */
  CLEAVE_LIFETIME_DERIVED = 5  /* not stored: computed when it is asked for */
};

enum cleave_motion {
  CLEAVE_MOTION_ACCELERATION = 1, /* acceleration given, integrated by velocity Verlet [CBM 19] */
  CLEAVE_MOTION_EXACT = 2         /* position given: no drift, exact energy audit */
};

/* What a material call hands out. sigma: Cauchy stress; R: rotation of the polar decomposition F = R U. */
enum cleave_stress_measure {
  CLEAVE_STRESS_FIRST_PIOLA = 0,  /* P, not symmetric */
  CLEAVE_STRESS_SECOND_PIOLA = 1, /* S = F^-1 P */
  CLEAVE_STRESS_CAUCHY = 2,       /* sigma = P F^T / J */
  CLEAVE_STRESS_COROTATED = 3,    /* R^T sigma R */
  CLEAVE_STRESS_KIRCHHOFF = 4     /* tau = J sigma */
};
enum cleave_tangent_measure {
  CLEAVE_TANGENT_FIRST_PIOLA = 0,  /* dP/dF */
  CLEAVE_TANGENT_SECOND_PIOLA = 1, /* dS/dE, E Green-Lagrange strain */
  CLEAVE_TANGENT_JAUMANN = 2,      /* of the Jaumann rate of tau to the stretching, divided by J */
  CLEAVE_TANGENT_COROTATED = 3     /* the same with all four indices turned back by R */
};

/* ---------------------------------------------------------------- messages and tables ---- */

/* Library version "major.minor.patch". */
CLEAVE_API const char* cleave_version(void);

/* ABI_MISMATCH unless abi is this library's CLEAVE_ABI_VERSION: for hosts that make array calls only.
 * [in] abi: CLEAVE_ABI_VERSION as the caller knows it. */
CLEAVE_API int32_t cleave_abi_check(int32_t abi);

/* Last message of this thread, copied with a terminating NUL, cut to `capacity` bytes.
 * [out] length (may be NULL): full length without the NUL. */
CLEAVE_API int32_t cleave_last_message(char* text, int64_t capacity, int64_t* length);

/* Sets the last message of this thread; for layers in other languages that check before they call. */
CLEAVE_API int32_t cleave_set_last_message(const char* text);

/* Text of a status code from the table; "unknown status" otherwise. */
CLEAVE_API const char* cleave_status_text(int32_t status);

/* A line of a table. */
typedef struct cleave_table_entry {
  int64_t size;
  int32_t value;      /* enumeration value; 0 in CLEAVE_TABLE_GROUP */
  const char* name;   /* as used in decks and in this interface */
  const char* title;  /* for people */
  const char* source; /* equation tag or reference; "" if none */
} cleave_table_entry;

/* Number of entries of a table (enum cleave_table). */
CLEAVE_API int32_t cleave_table_count(int32_t table, int64_t* count);
/* [in,out] entry: entry->size must be set to sizeof(cleave_table_entry). */
CLEAVE_API int32_t cleave_table_get(int32_t table, int64_t index, cleave_table_entry* entry);
/* Value of the entry called `name`; CLEAVE_UNKNOWN_NAME lists the known names. */
CLEAVE_API int32_t cleave_table_find(int32_t table, const char* name, int32_t* value);

/* A named parameter: of a material (owner "svk") or of a group (owner "fracture"). */
typedef struct cleave_parameter {
  int64_t size;
  const char* name;
  const char* units; /* "Pa", "1", ... */
  const char* description;
  const char* choices;        /* type CLEAVE_CHOICE: "paper|central|frozen"; else "" */
  const char* default_choice; /* type CLEAVE_CHOICE and not required */
  const char* source;         /* equation tag; "" if none */
  double minimum, maximum;    /* closed range unless the next two say otherwise */
  double default_value;
  int32_t type; /* enum cleave_type */
  int32_t minimum_excluded, maximum_excluded;
  int32_t required; /* 1: no default */
} cleave_parameter;

/* Parameters of a material or group; [in,out] parameter: parameter->size must be set to its sizeof. */
CLEAVE_API int32_t cleave_parameter_count(const char* owner, int64_t* count);
CLEAVE_API int32_t cleave_parameter_get(const char* owner, int64_t index,
                                        cleave_parameter* parameter);

/* A field: its line in the fields table, and its size in a body where there is one. */
typedef struct cleave_field {
  int64_t size;
  const char* name;
  const char* units;
  const char* description;
  const char* owner;          /* "core", a formulation or a material */
  const char* rebuild;        /* lifetime cache or derived: what computes it; else "" */
  int64_t count;              /* entries in this body; 0 in the table listing */
  int32_t components;         /* 1 scalar, 3 vector, 9 tensor, else n */
  int32_t type;               /* CLEAVE_REAL or CLEAVE_INTEGER */
  int32_t relation, lifetime; /* enums above */
  int32_t output;             /* 1: written to results unless the deck chooses fields itself */
} cleave_field;

/* The whole table: core fields, every formulation's, every material's history. */
CLEAVE_API int32_t cleave_field_table_count(int64_t* count);
CLEAVE_API int32_t cleave_field_table_get(int64_t index, cleave_field* field);
/* Hash over the fields table; a checkpoint carries it. */
CLEAVE_API int32_t cleave_field_table_fingerprint(uint64_t* fingerprint);

/* ---------------------------------------------------------------- array calls ---- */

/* The bonds of a body as a view of the caller's arrays, and the layout of his other arrays: component
 * c of the vector of particle i stands at v[i * vector_point + c * vector_component], in doubles; so
 * for tensors. The arrays of this struct itself are never strided. */
typedef struct cleave_network {
  int64_t size;
  int32_t dimension;  /* 2 or 3 */
  int32_t index_base; /* 0; 1: row_begin, neighbour, reverse and simplices count from 1 */
  int64_t particles;  /* n */
  int64_t* row_begin; /* (n+1) half-bonds of particle i are row_begin[i] <= b < row_begin[i+1] */
  int64_t* neighbour; /* (h) particle at the other end, ascending in a row */
  int64_t* reverse;   /* (h) the same bond seen from the other end */
  double* zeta;       /* (3,h) bond vector, reference configuration [m2] (2D: [m]) */
  double* volume;     /* (n) averaging volume [m3] (2D: [m2]) */
  int64_t vector_point, vector_component; /* X u x v f: default 3, 1 is a(3,n); a(n,3) is 1, n */
  int64_t tensor_point, tensor_component; /* H P: default 9, 1 is a(9,n); a(n,9) is 1, n */
} cleave_network;
/* Three dimensions, index base 0, default layouts; pointers NULL. */
CLEAVE_API int32_t cleave_network_init(cleave_network* network);

/* Counts the bonds of a simplex mesh into network->row_begin: h = row_begin[n] - row_begin[0]
 * half-bonds; allocate the other arrays of the network with it.
 * [in] simplices (dim+1,m)   particles */
CLEAVE_API int32_t cleave_cbm_count_bonds(const cleave_network* network, int64_t simplex_count,
                                          const int64_t* simplices);

/* Bond vectors and averaging volumes from the live simplices, into the arrays of the network.
 *                                                                          [CBM 1, 4-9]
 * [in]  X (3,n)        reference position [m]
 * [in]  alive (m)      0: the simplex is deleted; NULL: all live
 * Errors: BAD_SIMPLEX (volume not above 1e-12 of the cube of its longest edge; orientation is
 * free). */
CLEAVE_API int32_t cleave_cbm_bonds(const cleave_network* network, const double* X,
                                    int64_t simplex_count, const int64_t* simplices,
                                    const int32_t* alive);

/* Displacement gradient H = F - I of particles first..last.                    [CBM 8]
 * [in]  u (3,n)   displacement [m]
 * [out] H (9,n)   rows first..last are set; H33 = 0 in two dimensions; zero where volume is zero */
CLEAVE_API int32_t cleave_displacement_gradient(const cleave_network* network, int64_t first,
                                                int64_t last, const double* u, double* H);

/* Force of the bonds on particles first..last: sum_p (P_i zeta_ip - P_p zeta_pi).   [CBM 18, 19]
 * [in]     P (9,n)   first Piola-Kirchhoff stress [Pa]
 * [in,out] f (3,n)   force [N], added to, not set */
CLEAVE_API int32_t cleave_bond_force(const cleave_network* network, int64_t first, int64_t last,
                                     const double* P, double* f);

/* Artificial viscosity with frozen bond weights on particles first..last, see cleave_parameter_get
 * ("viscosity") for the forms of the model.                                     [CBM 21, 22]
 * [in]     w (h)       zeta_ip . X_ip [m3]
 * [in]     x, v (3,n)  position, velocity     [in] J (n) volume ratio det F
 * [in]     coefficient beta rho0 c0 [Pa s m-1]
 * [in]     length      l_c of the regularisation [m]
 * [in,out] f (3,n)     force [N], added to */
CLEAVE_API int32_t cleave_bond_viscosity(const cleave_network* network, int64_t first, int64_t last,
                                         const double* w, const double* x, const double* v,
                                         const double* J, double coefficient, double length,
                                         double* f);

/* Stress and energy density of a material law, points first..last.
 * [in]     properties        in the order of cleave_parameter_get(material name)
 * [in]     H (9,n)           displacement gradient F - I [1]
 * [in,out] history (nh,n)    history variables, nh = cleave_material_history_count; NULL if nh = 0
 * [out]    P (9,n)           first Piola-Kirchhoff stress [Pa]
 * [out]    energy (n)        stored energy per reference volume [J m-3]; may be NULL
 * [out]    failed (n)        1 where the law has no answer (P = 0, history untouched); may be NULL
 * Returns BAD_JACOBIAN if any point failed, after all points have been done. */
CLEAVE_API int32_t cleave_material_stress(int32_t material, int32_t kinematics,
                                          int64_t property_count, const double* properties,
                                          int64_t first, int64_t last, const double* H,
                                          double* history, double* P, double* energy,
                                          int32_t* failed);
CLEAVE_API int32_t cleave_material_history_count(int32_t material, int64_t* count);

/* The place in a point's history of the variable that is 1 where the law calls the material failed and
 * below 1 before (Johnson-Cook damage), so that a host can erode the point.  [out] place: 0-based; -1 if
 * the law has none. */
CLEAVE_API int32_t cleave_material_damage_place(int32_t material, int64_t* place);

/* A material update in the layout, component order and stress measure of the host, served where it
 * stands: a(9,n), a(n,9), padded leading dimensions. Component c of point q of an array stands at
 * base[point * q + component * c], strides counted in entries.  `order`: the places c, 0 to 8, of
 * 11 21 31 12 22 32 13 23 33 in this order; for an array that holds 11 22 33 12 23 31 21 32 13 that
 * is 0 6 5 3 1 7 8 4 2.  A symmetric tensor names the same place twice: 11 22 33 12 23 31 is
 * 0 3 5 3 1 4 5 4 2.  -1: the array lacks the component; read as zero (of F and of H), not written. */
typedef struct cleave_material_call {
  int64_t size;
  int32_t material;          /* enum cleave_material */
  int32_t kinematics;        /* enum cleave_kinematics */
  int64_t property_count;    /* as cleave_material_stress */
  const double* properties;  /* in the order of cleave_parameter_get */
  int64_t first, last;       /* points first <= q < last */
  double dt;                 /* size of the step [s]; 0: statics, no rates */
  double length;             /* size of a particle, for laws with shock viscosity [m] ... */
  const double* lengths;     /* ... or, if not NULL, of every point [m] */
  int64_t length_point;      /* default 1 */
  const double* deformation; /* H = F - I, which keeps the digits of small strains, or F [1] */
  int32_t deformation_is_F;  /* 0: H, 1: F */
  int32_t stress_measure;    /* enum cleave_stress_measure; default first Piola-Kirchhoff */
  int64_t deformation_point, deformation_component; /* default 9, 1 */
  int64_t deformation_order[9];                     /* default 0 ... 8 */
  double* history; /* in, out; variables one after another; NULL if the law has none */
  int64_t history_point, history_component; /* default 0 (as many as the law has), 1 */
  double* stress;                           /* out [Pa] */
  int64_t stress_point, stress_component;   /* default 9, 1 */
  int64_t
      stress_order[9];   /* default 0 ... 8; no place twice for the first Piola-Kirchhoff stress */
  double* energy;        /* out: stored, per reference volume [J m-3]; may be NULL */
  int64_t energy_point;  /* default 1 */
  double* plastic;       /* out: dissipated by plastic flow in this update [J m-3]; may be NULL */
  int64_t plastic_point; /* default 1 */
  double*
      viscous; /* out: dissipated by the law's own viscosity in this update [J m-3]; may be NULL */
  int64_t viscous_point; /* default 1 */
  int32_t* failed;       /* out: 1 where the law has no answer; may be NULL */
  int64_t failed_point;  /* default 1 */
  /* out, cleave_material_tangent [Pa]: the derivative of component a to component b at place
   * a + m b, a and b places as above: a of stress_order; b of deformation_order for dP/dF, of
   * stress_order for the others; m the largest place of stress_order plus one (9, symmetric 6). The
   * strain of a symmetric measure is engineering strain in this sense: entry ab is C_ijkl. */
  double* tangent;
  int64_t tangent_point, tangent_component; /* default 81, 1 */
  int32_t tangent_measure;                  /* enum cleave_tangent_measure; default dP/dF */
  int32_t index_base; /* messages count points from 0, the default, or 1; first and last from 0 */
} cleave_material_call;
/* Defaults: contiguous arrays in the order of this interface, all pointers NULL. */
CLEAVE_API int32_t cleave_material_call_init(cleave_material_call* call);
/* Stress, energies and history of the points.  Where the law has no answer stress and energies are zero,
 * the history untouched and failed 1; BAD_JACOBIAN is returned after all points have been done.
 * A point gets the same bits for any layout and range. */
CLEAVE_API int32_t cleave_material_update(const cleave_material_call* call);
/* Consistent tangent of the step from the history, which is left alone; stress, energy and
 * dissipation are not used.  In two dimensions the in-plane components, with P33 = 0 kept in plane
 * stress; the others are zero; measures other than dP/dF need CLEAVE_3D.  Call it before
 * cleave_material_update. */
CLEAVE_API int32_t cleave_material_tangent(const cleave_material_call* call);

/* Longitudinal wave speed of the undeformed material (plane stress: plate speed) [m s-1]. */
CLEAVE_API int32_t cleave_material_wave_speed(int32_t material, int32_t kinematics,
                                              int64_t property_count, const double* properties,
                                              double* speed);

/* Smooth ramps with s = t/tau: displacement u*(6s^5-15s^4+10s^3) [CBM 26], velocity v*(3s^2-2s^3)
 * [CBM 30]; constant afterwards, zero for t <= 0.  tau = 0: a jump.
 * [out] displacement, velocity, acceleration: may be NULL */
enum cleave_ramp_kind { CLEAVE_RAMP_DISPLACEMENT = 1, CLEAVE_RAMP_VELOCITY = 2 };
CLEAVE_API int32_t cleave_ramp(int32_t kind, double value, double tau, double t,
                               double* displacement, double* velocity, double* acceleration);

/* ---------------------------------------------------------------- model handle ---- */

typedef struct cleave_model cleave_model;

/* [in] abi: CLEAVE_ABI_VERSION as the caller knows it. */
CLEAVE_API int32_t cleave_model_create(int32_t abi, cleave_model** model);
/* NULL is allowed. */
CLEAVE_API int32_t cleave_model_destroy(cleave_model* model);
/* What messages count bodies, particles and simplices from: 0, the default, or 1. Before the first
 * body; the arguments of this interface count from 0 whatever it is. */
CLEAVE_API int32_t cleave_model_set_index_base(cleave_model* model, int32_t base);
/* Threads the kernels may use; default 1.  Results do not depend on it, bit for bit. */
CLEAVE_API int32_t cleave_model_set_threads(cleave_model* model, int32_t threads);

/* The order of operations of the explicit step, before cleave_model_setup. Results differ by rounding.
 * BLOCKS, the default: fixed blocks of particles, the fastest, for any number of threads. ROWS: that of the
 * array calls, the bits of a host that calls them in its own loops. */
enum cleave_order { CLEAVE_ORDER_BLOCKS = 1, CLEAVE_ORDER_ROWS = 2 };
CLEAVE_API int32_t cleave_model_set_order(cleave_model* model, int32_t order);

typedef struct cleave_body_spec {
  int64_t size;
  int32_t formulation;      /* enum cleave_formulation */
  int32_t kinematics;       /* enum cleave_kinematics */
  int32_t material;         /* enum cleave_material */
  int32_t simplex_nodes;    /* particles of a simplex; 0: dim+1; 6: six-node triangles (fem) */
  int64_t particles;        /* n > 0 */
  const double* X;          /* (3,n) reference position [m]; copied */
  int64_t simplex_count;    /* m >= 0 */
  const int64_t* simplices; /* (simplex_nodes,m) 0-based; copied; orientation is free */
  const char* name;         /* used in messages; copied */
} cleave_body_spec;
CLEAVE_API int32_t cleave_body_spec_init(cleave_body_spec* spec);

/* Adds a body.  [out] body: its index, 0, 1, ... */
CLEAVE_API int32_t cleave_body_add(cleave_model* model, const cleave_body_spec* spec,
                                   int64_t* body);

/* Parameters before cleave_model_setup.  group: "material" (the body's law) or a name of
 * CLEAVE_TABLE_GROUP.  Unknown names list the known ones; values are checked against their range.
 */
CLEAVE_API int32_t cleave_body_set_real(cleave_model* model, int64_t body, const char* group,
                                        const char* name, double value);
CLEAVE_API int32_t cleave_body_set_choice(cleave_model* model, int64_t body, const char* group,
                                          const char* name, const char* choice);
/* Value in force, default or set; after set-up also for defaults computed from others. */
CLEAVE_API int32_t cleave_body_get_real(cleave_model* model, int64_t body, const char* group,
                                        const char* name, double* value);

/* Prescribed degrees of freedom, before cleave_model_setup; replaces an earlier list.  A particle
 * and direction may occur once.  Bonds whose ends are both prescribed in every direction of the
 * body's dimension, or both listed in cleave_body_exempt (bond_pd, cpd and lps: one of them), are never
 * broken. [in] particle, direction (n): direction 0, 1, 2    [in] motion (n): enum cleave_motion */
CLEAVE_API int32_t cleave_body_prescribe(cleave_model* model, int64_t body, int64_t count,
                                         const int64_t* particle, const int32_t* direction,
                                         const int32_t* motion);
/* Particles of a zone without fracture: bonds with both ends in the list are exempt, those of bond_pd, cpd
 * and lps with one end.  Before
 * set-up; adds up. */
CLEAVE_API int32_t cleave_body_exempt(cleave_model* model, int64_t body, int64_t count,
                                      const int64_t* particle);

/* Volumes of the particles of a body, instead of shares of its simplices, which it then needs not have;
 * before set-up, for formulations bond_pd, cpd and lps.
 * [in] volume (n)   reference volume, > 0 [m3] (2D: [m2]) */
CLEAVE_API int32_t cleave_body_volumes(cleave_model* model, int64_t body, int64_t count,
                                       const double* volume);

/* Another material for particles of a body; before set-up, for formulations bond_pd, cpd and lps. What bonds
 * between two materials do says group peridynamics. Where regions overlap the later one counts.
 * [in] particle (n)     [in] properties (property_count)   as cleave_material_stress
 * [in] critical_strain  of bonds in the region [1], or Gf, their fracture energy [J m-2]: one of them > 0;
 *                       both 0: what group fracture says, with the constants of this material */
CLEAVE_API int32_t cleave_body_region(cleave_model* model, int64_t body, int64_t count,
                                      const int64_t* particle, int32_t material,
                                      int64_t property_count, const double* properties,
                                      double critical_strain, double Gf);

/* Checks everything and builds bonds, masses and fields.  Errors name the body and the parameter.
 */
CLEAVE_API int32_t cleave_model_setup(cleave_model* model);

/* Breaks bonds without an event and without energy: pre-cracks.  After set-up, before the first
 * step.  [in] pairs (2,n): particles at the ends, any order; BAD_ARGUMENT if they are not bonded.
 */
CLEAVE_API int32_t cleave_body_precrack(cleave_model* model, int64_t body, int64_t count,
                                        const int64_t* pairs);

/* Largest step that the formulations call stable, with their safety [s], shortened by the present
 * deformation.   theory: time step */
CLEAVE_API int32_t cleave_model_stable_step(cleave_model* model, double* step);
/* Whether dt <= that step: the same answer, cheaper, for hosts that ask before every step.
 * [out] stable: 1 or 0 */
CLEAVE_API int32_t cleave_model_is_stable(cleave_model* model, double dt, int32_t* stable);
CLEAVE_API int32_t cleave_body_wave_speed(cleave_model* model, int64_t body, double* speed);

/* ---- stepping: once initialise, then for every step advance, [loads], update.
 *
 *   cleave_body_motion(u(t1) ...)            values at the start
 *   cleave_model_initialise(t0)              forces and accelerations at t0
 *   loop
 *     cleave_body_motion(...)                exact: u at the END of the step;
 *     cleave_model_advance(dt, t_new)        v += dt/2 a, u += dt v
 *     put "external_force" if it changes;
 *     cleave_body_motion(...)                accelerations at t_new
 *     cleave_model_update()                  break, gradient, stress, forces, a = f/m, v += dt/2 a
 *
 * displacement (n), acceleration (n) are in the order of cleave_body_prescribe; either may be NULL
 * to leave the values as they are.  Only the displacement of CLEAVE_MOTION_EXACT entries is used.
 * For those pass as acceleration (u(t+dt) - 2 u(t) + u(t-dt))/dt^2 of the curve at the t of the
 * update, with the next step's dt: then v(t+dt/2) is exactly (u(t+dt) - u(t))/dt. */
CLEAVE_API int32_t cleave_body_motion(cleave_model* model, int64_t body, int64_t count,
                                      const double* displacement, const double* acceleration);
CLEAVE_API int32_t cleave_model_initialise(cleave_model* model, double time);
CLEAVE_API int32_t cleave_model_advance(cleave_model* model, double dt, double time_new);
CLEAVE_API int32_t cleave_model_update(cleave_model* model);

/* ---- statics: once initialise, then for every load increment motion (displacements at its end),
 * external_force, solve_static.  Newton's method with the consistent tangent; inertia, viscosity and
 * rates play no part; prescribed degrees of freedom go where cleave_body_motion says. */
enum cleave_solver {
  CLEAVE_SOLVER_DIRECT = 0,   /* the stiffness is factorised */
  CLEAVE_SOLVER_ITERATIVE = 1 /* conjugate gradients, if it is symmetric positive definite: less
                                 memory and time in large bodies */
};
enum cleave_breaking {
  CLEAVE_BREAKING_ALL = 1, /* every bond that fails in an equilibrium */
  CLEAVE_BREAKING_ONE = 2, /* the one furthest beyond its limit, the first of equals */
  CLEAVE_BREAKING_TIES = 3 /* that one, and those that are as far beyond within 1e-9 */
};
typedef struct cleave_static_options {
  int64_t size;
  double tolerance;       /* norm of the residual over that of all forces; default 1e-9 */
  int32_t max_iterations; /* default 25 */
  int32_t
      stop_at_limit; /* 1: go no further than to where a first bond reaches its limit; default 0 */
  int32_t solver;    /* enum cleave_solver, of the linear systems; default DIRECT */
  int32_t breaking;  /* enum cleave_breaking, of cleave_model_break_static; default ALL */
  int32_t corrections; /* bonds that a kept factor is corrected for at most; 0: a new one for each;
                          default -1: while it pays */
  int32_t reserved;
} cleave_static_options;
typedef struct cleave_static_report {
  int64_t size;
  int64_t iterations; /* the largest of the bodies */
  int64_t unknowns;   /* of all bodies */
  double residual;    /* relative, the largest of the bodies */
  double fraction;    /* 1: done; less: of the way, see stop_at_limit */
  int64_t broken;     /* bonds that this call broke */
  int64_t critical;   /* bonds beyond their limits now, of those that may break */
} cleave_static_report;
CLEAVE_API int32_t cleave_static_options_init(cleave_static_options* options);
/* From the present equilibrium to the next, at time_new (a label: loads are functions of it). No bond breaks.
 * With stop_at_limit and a bond that would be loaded beyond its limit the state stays as it was, and
 * report->fraction < 1 is the part of the way at which the first one gets there (to first order): move the
 * loads to there and call again.
 * [in]  options: NULL for the defaults      [out] report: may be NULL; report->size must be set
 * Errors: NO_CONVERGENCE (also BAD_JACOBIAN of the law), the state is as before the call: try a smaller
 * increment; UNSUPPORTED (a body has forces that are not its gradient operator's). */
CLEAVE_API int32_t cleave_model_solve_static(cleave_model* model, double time_new,
                                             const cleave_static_options* options,
                                             cleave_static_report* report);
/* Breaks bonds that are beyond their limits in the present equilibrium, as options->breaking says, and finds
 * the next under the same loads, which may fail other bonds: call it until report->broken is 0. Particles
 * that too few bonds hold lose them all.
 * Arguments and errors as above: after NO_CONVERGENCE nothing has broken.          theory: relaxation */
CLEAVE_API int32_t cleave_model_break_static(cleave_model* model,
                                             const cleave_static_options* options,
                                             cleave_static_report* report);

/* ---- statics by dynamic relaxation, for every formulation and bonds that break: instead of
 * cleave_model_solve_static. No matrix and no tangent: the forces are evaluated many times. One load
 * increment: the boundary and the forces take their new values, the body relaxes to equilibrium, bonds that
 * fail there break, it relaxes again, until nothing fails.                          theory: relaxation */
typedef struct cleave_relaxation_options {
  int64_t size;
  double tolerance;       /* norm of the residual over that of all forces; default 1e-6 */
  int64_t max_iterations; /* of one relaxation; default 100000 */
  int64_t slice;          /* iterations of one call; default 0: until it is done */
  int32_t breaking;       /* enum cleave_breaking; default ALL */
  int32_t reserved;
} cleave_relaxation_options;
typedef struct cleave_relaxation_report {
  int64_t size;
  int64_t iterations; /* evaluations of the forces in this increment, of all bodies */
  int64_t rounds;     /* equilibria of this increment in which bonds broke */
  int64_t broken;     /* bonds that broke in this increment */
  int64_t unknowns;   /* of all bodies */
  int64_t finished;   /* 1: equilibrium without failing bonds; 0: the slice is used up */
  double residual;    /* relative, the largest of the bodies */
} cleave_relaxation_report;
CLEAVE_API int32_t cleave_relaxation_options_init(cleave_relaxation_options* options);
/* From the present equilibrium to the next, at time_new (a label: loads are functions of it). With a slice
 * and finished = 0 the model is on the way: the same call goes on (of the options only slice may change),
 * cleave_model_relax_cancel goes back to the equilibrium before; anything else but questions is refused or
 * spoils the increment. The result does not depend on slices.
 * [in]  options: NULL for the defaults      [out] report: may be NULL; report->size must be set
 * Errors: NO_CONVERGENCE, the state, with its bonds and events, is as before the increment: try a smaller
 * one; UNSUPPORTED (a body has forces that no equilibrium can be found with). */
CLEAVE_API int32_t cleave_model_relax(cleave_model* model, double time_new,
                                      const cleave_relaxation_options* options,
                                      cleave_relaxation_report* report);
CLEAVE_API int32_t cleave_model_relax_cancel(cleave_model* model);

/* Bonds broken by the steps since the last cleave_body_clear_events. */
typedef struct cleave_event {
  int64_t size;
  int64_t step;          /* number of the step that broke it, 1 = first */
  int64_t first, second; /* particles at the ends, first < second */
  double time;           /* [s] end of that step */
  double midpoint[3];    /* reference position of the middle [m] */
  double criterion;      /* value of the criterion: bond strain [1], or its force [N], energy [J] */
  double limit;          /* its critical value */
  double released;       /* energy released by this bond [J]; the sum over bonds is the ledger's
                            without what bonds have lost that soften and are not broken */
} cleave_event;
CLEAVE_API int32_t cleave_body_event_count(cleave_model* model, int64_t body, int64_t* count);
CLEAVE_API int32_t cleave_body_event_get(cleave_model* model, int64_t body, int64_t index,
                                         cleave_event* event);
CLEAVE_API int32_t cleave_body_clear_events(cleave_model* model, int64_t body);

/* Energy ledger at the end of the last step [J] (2D: [J m-1]).  theory: energy audit, CBM
 * section 7. */
typedef struct cleave_energies {
  int64_t size;
  double kinetic;           /* 1/2 m v^2 at t */
  double kinetic_staggered; /* 1/2 m v(t-dt/2).v(t+dt/2) */
  double elastic;           /* stored in the particles */
  double plastic;           /* plastic work */
  double stabilisation;     /* stored by the hourglass stabilisation */
  double fracture;          /* released by bonds that break or soften */
  double viscous;           /* dissipated by artificial viscosity; by the damping of relaxation */
  double external;          /* work of external forces */
  double reaction;          /* work of the forces that keep prescribed motion */
  double internal;          /* work done against internal forces (trapezoid) */
  double balance;           /* kinetic + stored + dissipated - work - the same at the start */
  double identity;          /* discrete identity of the integrator, same form with `internal` */
  double hourglass;         /* diagnostic E_hg [CBM hourglass], not part of the balance */
} cleave_energies;
/* body = -1: sum over all bodies. */
CLEAVE_API int32_t cleave_energies_get(cleave_model* model, int64_t body,
                                       cleave_energies* energies);

/* Counts for status lines. */
typedef struct cleave_counts {
  int64_t size;
  int64_t particles, bonds, simplices;
  int64_t broken;   /* bonds that met the criterion */
  int64_t inert;    /* bonds that lost all their simplices otherwise, pre-cracks among them */
  int64_t isolated; /* particles without a live simplex */
  int64_t inverted; /* particles with det F <= 0 at the last update */
} cleave_counts;
CLEAVE_API int32_t cleave_counts_get(cleave_model* model, int64_t body, cleave_counts* counts);
/* Bytes held by the model. */
CLEAVE_API int32_t cleave_model_memory(cleave_model* model, int64_t* bytes);

/* Sum over the listed particles of the reaction (force that keeps the prescribed motion), [N]. */
CLEAVE_API int32_t cleave_body_reaction(cleave_model* model, int64_t body, int64_t count,
                                        const int64_t* particle, double force[3]);

/* ---- fields of a body, after set-up.  Values of particles, bonds and simplices stand in the
 * order in which the caller gave particles and simplices (bonds: sorted by first, then second end).
 */
CLEAVE_API int32_t cleave_field_count(cleave_model* model, int64_t body, int64_t* count);
CLEAVE_API int32_t cleave_field_get(cleave_model* model, int64_t body, int64_t index,
                                    cleave_field* field);
CLEAVE_API int32_t cleave_field_find(cleave_model* model, int64_t body, const char* name,
                                     cleave_field* field);
/* values (components, last-first) */
CLEAVE_API int32_t cleave_field_get_real(cleave_model* model, int64_t body, const char* name,
                                         int64_t first, int64_t last, double* values);
CLEAVE_API int32_t cleave_field_put_real(cleave_model* model, int64_t body, const char* name,
                                         int64_t first, int64_t last, const double* values);
CLEAVE_API int32_t cleave_field_get_integer(cleave_model* model, int64_t body, const char* name,
                                            int64_t first, int64_t last, int64_t* values);
CLEAVE_API int32_t cleave_field_put_integer(cleave_model* model, int64_t body, const char* name,
                                            int64_t first, int64_t last, const int64_t* values);

/* Fields at any points of the reference configuration, through the simplices of the body.  Locate once,
 * interpolate as often as wanted.  Fields of particles are linear in a simplex (quadratic with six
 * nodes); fields of integration points are the constant or linear function through those of the
 * element.
 * [in]  X (3,n)         reference positions [m]
 * [out] simplex (n)     the simplex that holds the point, -1 outside of the body
 * [out] weight (4,n)    its barycentric coordinates
 * [out] values (components,n)   zero outside */
CLEAVE_API int32_t cleave_body_locate(cleave_model* model, int64_t body, int64_t count,
                                      const double* X, int64_t* simplex, double* weight);
CLEAVE_API int32_t cleave_field_interpolate(cleave_model* model, int64_t body, const char* name,
                                            int64_t count, const int64_t* simplex,
                                            const double* weight, double* values);

/* After all setup and state fields were put: rebuilds the caches and sets the clock.  Stepping then
 * continues as if it had never stopped, bit for bit. */
CLEAVE_API int32_t cleave_model_restore(cleave_model* model, int64_t step, double time);
CLEAVE_API int32_t cleave_model_clock(cleave_model* model, int64_t* step, double* time);

#ifdef __cplusplus
}
#endif
#endif
