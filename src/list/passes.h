/* The GL passes of the list method, over one region of the frame. */
#ifndef MNS_LIST_PASSES_H
#define MNS_LIST_PASSES_H

#include "gl/buffer.h"
#include "gl/program.h"
#include "list/order.h"
#include "list/uniforms.h"

typedef struct list_region {
    int x, y, width, height; /* GL pixels: from the lower left */
} list_region;

/* What a cast leaves to be read, as in glsl/redo.glsl. */
typedef struct list_counts {
    uint32_t redo, disorder, active, steps, undecided_float, undecided, unfinished, spare;
} list_counts;

/* The GL objects of the list method; zeroed is empty. Textures are of the frame's size. */
typedef struct list_passes {
    gl_buffer balls, balls_low, cores, colors, nodes, counter, redo, view, view_wide, far_block;
    gl_buffer tile_heads;                           /* of the tiles' lists; these hold the balls themselves */
    gl_buffer squares;                              /* of pixels to be cast */
    gl_buffer backwards;                            /* n - 1, ..., 1, 0 */
    GLuint heads, core_depth, host_depth;           /* textures */
    GLuint ball_texels, node_texels, head_texels;   /* buffer textures (TEXELS) */
    GLuint heads_target, depth_target, bare_target; /* framebuffers */
    GLuint vertex_array;
    int width, height;
    int tile_grid[4];                 /* as in glsl/tiles.glsl */
    size_t square_count;              /* squares, four 16-bit numbers each */
    float view_now[VIEW_VECTORS * 4]; /* what `view` holds */
    size_t node_capacity;
    size_t redo_capacity; /* pixels of a region at most */
} list_passes;

/* How the plane of what is blended of the balls is stored. Halves do for colours; which ray is worth its cost
 * hangs on a material's shares, and so on their last digits. */
static inline GLenum list_color_format(const mns_plan *plan)
{
    return plan->features & FEATURE_MATERIALS ? GL_RGBA32F : GL_RGBA16F;
}

/* Makes or resizes what the plan needs, and no more. Errors: MEMORY, GL. */
mns_status list_passes_prepare(list_passes *p, gl_device *device, const mns_plan *plan, mns_error *error);
void list_passes_free(list_passes *p, gl_device *device);

/* Compiles (or finds) the plan's programs that `order` makes needed. */
mns_status list_passes_compile(gl_device *device, gl_programs *programs, const mns_plan *plan,
                               GLuint program[SHADER_COUNT], mns_error *error);

/* Clears depth and lays down the host's (plan HOST) and the cores' (plan CORE). */
void list_core_depth(list_passes *p, gl_device *device, const mns_plan *plan, const list_order *order,
                     const GLuint program[SHADER_COUNT], list_region region);

/* Gathers the lists of a region. Returns the nodes wanted, the one that ends every list included; where that
 * is more than the pool holds, gather again. */
size_t list_gather(list_passes *p, gl_device *device, const mns_plan *plan, const list_order *order,
                   const GLuint program[SHADER_COUNT], list_region region);

/* Puts every list of a region in the order of the balls. counts->disorder: pixels at which the driver cut the
 * sort short. */
void list_sort_nodes(list_passes *p, gl_device *device, GLuint program, list_region region,
                     list_counts *counts);

void list_shuffle(list_passes *p, gl_device *device, const mns_plan *plan, const GLuint program[SHADER_COUNT],
                  list_region region);

/* Makes a region of `target` (t, normal, color planes) a miss that is certain. */
void list_clear_planes(list_passes *p, gl_device *device, const mns_plan *plan, GLuint target,
                       list_region region);

/* Casts a region into `target` (t, normal, color planes) and tells what is left to resolve. */
void list_cast(list_passes *p, gl_device *device, const mns_plan *plan, const GLuint program[SHADER_COUNT],
               GLuint target, list_region region, list_counts *counts);

/* Takes the redo list's entries on by `program`, in float or in doubles (which need balls_low), until none is
 * unfinished, into the planes' textures (t, normal, color or 0). */
void list_resolve(list_passes *p, gl_device *device, const mns_plan *plan, GLuint program, bool wide,
                  const GLuint plane[3], list_counts *counts);

#endif
