/* The makers of the suite's cases; `number` is stiff_case.number. */
#ifndef MNS_COMPARE_STIFF_MAKERS_H
#define MNS_COMPARE_STIFF_MAKERS_H

#include "compare/stiff_scene.h"

/* ---- Where the field and the eye are: stiff_place.c ---- */

void stiff_offset(stiff_scene *scene, const double *number);  /* moved by, scale */
void stiff_far_eye(stiff_scene *scene, const double *number); /* largest radii away */
void stiff_scaled(stiff_scene *scene, const double *number);  /* scale */
void stiff_spread(stiff_scene *scene, const double *number);  /* smallest and largest radius, one ball each */
void stiff_eye_in_ball(stiff_scene *scene, const double *number);
void stiff_eye_inside(stiff_scene *scene, const double *number);
void stiff_eye_at_centre(stiff_scene *scene, const double *number);
void stiff_eye_on_surface(stiff_scene *scene, const double *number); /* off it by, in radii: > 0 outside */
void stiff_near_plane(stiff_scene *scene, const double *number);
void stiff_wide_view(stiff_scene *scene, const double *number); /* degrees */
void stiff_frame(stiff_scene *scene, const double *number);     /* width, height */
void stiff_one_ball(stiff_scene *scene, const double *number);
void stiff_no_ball(stiff_scene *scene, const double *number);
void stiff_one_pixel(stiff_scene *scene, const double *number);

/* ---- How many, how strong, how different: stiff_crowd.c ---- */

void stiff_ratio_near(stiff_scene *scene, const double *number); /* R_max / R_min */
void stiff_ratio_far(stiff_scene *scene, const double *number);  /* R_max / R_min */
void stiff_coincident(stiff_scene *scene, const double *number); /* balls, within R times, L */
void stiff_cancelling(stiff_scene *scene, const double *number); /* strength of either sign, within R times */
void stiff_active(stiff_scene *scene, const double *number);     /* balls, L */
void stiff_level(stiff_scene *scene, const double *number);      /* L */
void stiff_level_alone(stiff_scene *scene, const double *number); /* L */
void stiff_strengths(stiff_scene *scene, const double *number);   /* decades about 1 */
void stiff_carving(stiff_scene *scene, const double *number);     /* strength of what carves */
void stiff_million(stiff_scene *scene, const double *number);     /* balls */
void stiff_line(stiff_scene *scene, const double *number);        /* balls */

/* ---- Rays that touch, and what is thin: stiff_touch.c ---- */

void stiff_silhouettes(stiff_scene *scene, const double *number);
void stiff_necks(stiff_scene *scene, const double *number);
void stiff_saddles(stiff_scene *scene, const double *number);
void stiff_rings(stiff_scene *scene, const double *number);
void stiff_film_face(stiff_scene *scene, const double *number); /* least f over L, less 1 */
void stiff_film_edge(stiff_scene *scene, const double *number); /* largest f over L, less 1 */
void stiff_gap(stiff_scene *scene, const double *number);       /* 1 less f in the gap over L */
void stiff_gap_inside(stiff_scene *scene, const double *number);

#endif
