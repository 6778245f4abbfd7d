/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The library itself: versions, how structs grow, results, errors, and contexts for progress and cancel. Part of meander.h. */
#ifndef MEANDER_LIBRARY_H
#define MEANDER_LIBRARY_H

#include <stddef.h>
#include <stdint.h>

/* Define MEANDER_STATIC to link with a static library. MEANDER_BUILDING is for the library itself. */
#if defined(MEANDER_STATIC)
#define MEANDER_API
#elif defined(_WIN32) && defined(MEANDER_BUILDING)
#define MEANDER_API __declspec(dllexport)
#elif defined(_WIN32)
#define MEANDER_API __declspec(dllimport)
#elif defined(__GNUC__)
#define MEANDER_API __attribute__((visibility("default")))
#else
#define MEANDER_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------ */
/* Versions                                                                                     */

/* The library's version, such as "0.1.0"; static storage. Any thread. */
MEANDER_API const char* meander_version(void);

/* The MEANDER_ABI_VERSION that the library was built with. Compare it before any other call: where
 * it differs from the header's, nothing else may be called. Any thread. */
MEANDER_API uint32_t meander_abi_version(void);

/* ------------------------------------------------------------------------------------------ */
/* Structs
 *
 * `struct_size` says how much of a struct the caller knows: the size that it had in the caller's
 * header. Every _init function takes that size, `sizeof` of the struct, fills no more than that, and
 * sets struct_size to it. It returns MEANDER_STATUS_INVALID_ARGUMENT for NULL, and for a size that
 * is smaller than the struct was in the first header of this ABI or larger than 4096.
 *
 *   An older, shorter struct   Fields beyond its end have their defaults; outputs are written up to
 *                              its end and no further.
 *   A newer, longer struct     What lies beyond the fields that the library knows must be zero, as
 *                              _init leaves it, or the call is refused with
 *                              MEANDER_STATUS_INVALID_ARGUMENT: the caller wants something that this
 *                              library cannot do. In outputs it is set to zero.
 *   reserved                   Room for fields to come, in which zero will mean: as before. _init
 *                              sets it to zero, and what is passed in must still be zero. */

/* How the library lays out a struct, so that a binding can compare its own declaration.
 *
 * name      of a struct of this header that is not opaque, such as "meander_seed"
 * layout    receives, up to `capacity` values: sizeof(struct), then the offset of every field in
 *           the order of declaration; may be NULL when capacity is 0
 * returns   1 + the number of fields; 0 if the name is unknown or NULL. Any thread. */
MEANDER_API size_t meander_struct_layout(const char* name, size_t* layout, size_t capacity);

/* ------------------------------------------------------------------------------------------ */
/* Results
 *
 * A call whose outputs are as long as they turn out to be fills a struct of counts and pointers, which
 * its _init function has prepared as any other struct. The arrays belong to the field `result`: they
 * never change, may be read from any thread, and last until it is destroyed, whatever happens to the
 * object that they are of. A pointer is NULL where its array would be empty. A struct that is filled
 * again forgets what it pointed to, so destroy its result first. */

typedef struct meander_result meander_result;

/* Frees all arrays of a struct. NULL, as _init leaves it, is allowed. Any thread. */
MEANDER_API void meander_result_destroy(meander_result* result);

/* ------------------------------------------------------------------------------------------ */
/* Status and errors                                                                            */

typedef int32_t meander_status;
enum {
  MEANDER_STATUS_OK = 0,
  MEANDER_STATUS_INVALID_ARGUMENT = 1, /* a NULL, a size, an option out of its range */
  MEANDER_STATUS_INVALID_MESH = 2,     /* the mesh cannot be used; the element says where */
  MEANDER_STATUS_INVALID_SEED = 3,     /* off the surface, crossing or touching itself, too short */
  MEANDER_STATUS_CANCELLED = 4,        /* the context was cancelled; everything is intact, and a flow
                                          can continue */
  MEANDER_STATUS_OUT_OF_MEMORY = 5,
  MEANDER_STATUS_INTERNAL = 6          /* a defect of the library; the sentence says what to report */
};

/* A short name of a status, such as "invalid mesh"; never NULL; static storage. Any thread. */
MEANDER_API const char* meander_status_name(meander_status status);

/* What the indices of an error count. */
typedef uint32_t meander_element;
enum {
  MEANDER_ELEMENT_NONE = 0,
  MEANDER_ELEMENT_VERTEX = 1,    /* index of a vertex */
  MEANDER_ELEMENT_FACE = 2,      /* index of a face */
  MEANDER_ELEMENT_EDGE = 3,      /* index of one end vertex; element_index2 is the other */
  MEANDER_ELEMENT_SEED_POINT = 4 /* index of a seed point; element_index2 is another one where two
                                    segments meet, or else the same */
};

/* Filled by the library when a call fails, untouched when it succeeds. Owned by the caller; may be
 * NULL in every call. One whose struct_size is too small to be valid receives nothing. */
typedef struct meander_error {
  uint32_t struct_size; /* set by meander_error_init */
  meander_status status;
  meander_element element_kind;
  uint32_t element_index;
  uint32_t element_index2;
  char text[492]; /* UTF-8, zero-terminated, one sentence */
  uint64_t reserved[4];
} meander_error;

/* Prepares an error; see "Structs".
 *
 * error        receives struct_size and zeros
 * struct_size  sizeof(meander_error) */
MEANDER_API meander_status meander_error_init(meander_error* error, size_t struct_size);

/* ------------------------------------------------------------------------------------------ */
/* Context: progress and cancel                                                                 */

typedef struct meander_context meander_context;

/* Creates a context that is not cancelled.
 *
 * context   receives it; destroy it with meander_context_destroy. Any thread. */
MEANDER_API meander_status meander_context_create(meander_context** context, meander_error* error);

/* Frees a context; NULL is allowed. No call may be using it, except a run that was started with it:
 * that continues, and then only meander_flow_destroy can cancel it. */
MEANDER_API void meander_context_destroy(meander_context* context);

/* Asks every call that was given this context to return MEANDER_STATUS_CANCELLED soon: a flow within
 * one iteration, mostly within a small part of it, other calls before they begin and at the points
 * that their descriptions name. Everything is then as it was before the call, or before the iteration.
 * Sticky and idempotent; NULL is ignored. Any thread. */
MEANDER_API void meander_context_cancel(meander_context* context);

/* Takes a cancel back, so that the context can be used again, and sets its progress to 0. NULL is
 * ignored. Any thread; no call may be using the context. */
MEANDER_API void meander_context_reset(meander_context* context);

/* How far the present run of a flow is, as a share of the expected work: in [0, 1], never falling
 * during one run, 1 when the run has ended for whatever reason. It is an estimate: while the curve grows
 * it follows the length of the curve towards the length that is expected to fill the surface, and then
 * the iterations. Updated once an iteration, and after each step of laying a first curve, by
 * meander_flow_run, by a started run and by meander_flow_step, whose steps are one run until a reset;
 * 0 before the first run, after a reset, and for NULL. Also how far a search for gaps is, and the making
 * of a surface and of a flow, while it lasts. Any thread. */
MEANDER_API double meander_context_progress(const meander_context* context);

/* What the present run of a flow is about. */
typedef uint32_t meander_phase;
enum {
  MEANDER_PHASE_NONE = 0,            /* no iteration yet */
  MEANDER_PHASE_GROWTH = 1,          /* the curve becomes longer until it fills the surface */
  MEANDER_PHASE_HAIRPIN_REMOVAL = 2, /* its hairpins are drawn in; see hairpin_removal_iterations */
  MEANDER_PHASE_POLISH = 3           /* it becomes even, and comes to rest */
};

/* The phase that the last iteration of the present run has left the flow in; growth while a first curve
 * is laid. Updated with the progress; MEANDER_PHASE_NONE before the first run, after a reset, and for
 * NULL. Without a polish, as in the preset paper, all of a run is growth. Any thread. */
MEANDER_API meander_phase meander_context_phase(const meander_context* context);

#ifdef __cplusplus
}
#endif

#endif /* MEANDER_LIBRARY_H */
