#include "shade/effects.h"

#include "base/color.h"
#include "base/status.h"
#include "effects/environment.h"
#include "list/uniforms.h"
#include "shade/shade.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum {
    UNIFORM_REGION = 3,
    UNIFORM_LISTS = 4,
    LISTS = 4,
    PATH_LIGHTS = 256,
    STORE_WALK = 11,
    STORE_WAIT = 3,
    GROUP = 64,
    BINDING_STORE = 7,
    BLOCK_WIDTH = 4, /* as glsl/effects_list.glsl has them */
    BLOCK_HEIGHT = 2
};

#define ENTRY_BYTES ((size_t)16)
#define STORE_BYTES ((size_t)128 << 20) /* of walks that wait: a larger frame is lit in parts */

/* Beyond this distance from the field a light is moved nearer, in its direction and in proportion: floats
 * square it, and nothing of it is seen to change. */
#define LIGHT_FARTHEST 1e18
/* Light and absorption beyond this are sent as this: a float's infinity times no share would be no number. */
#define MOST 1e30

/* As glsl/paths.glsl has it. */
typedef struct effects_block {
    double corner[4], step_x[4], step_y[4], eye[4], optics[4], place[PATH_LIGHTS][4];
    float radiance[PATH_LIGHTS][4];
    float right[4], up[4], back[4], absorption[4];
    int32_t counts[4];
    uint32_t levels[4];
    int32_t size[4];
    uint32_t solids[4];
} effects_block;

/* ---- What is sent ---- */

static void put_light(effects_block *block, size_t i, const mns_plan *plan)
{
    const mns_light *light = &plan->light[i];
    vec3 origin = vec3_load(plan->tree_origin);
    vec3 place = light->kind == MNS_LIGHT_DIRECTIONAL ? vec3_unit(vec3_load(light->direction))
                 : light->kind == MNS_LIGHT_HEAD      ? vec3_sub(plan->frame.eye, origin)
                                                      : vec3_sub(vec3_load(light->position), origin);
    double radius = light->kind == MNS_LIGHT_AREA ? light->radius : 0;
    double nearer = fmin(1, LIGHT_FARTHEST / vec3_length(place));
    vec3_store(block->place[i], vec3_scale(place, nearer));
    block->place[i][3] = radius * nearer;
    for (int c = 0; c < 3; c++)
        block->radiance[i][c] = (float)fmin(light->strength * color_linear(light->color[c]), MOST);
    block->radiance[i][3] = (float)light->kind;
    block->counts[1] += light->kind != MNS_LIGHT_HEAD;
}

static void put_axis(float to[4], vec3 v)
{
    to[0] = (float)v.x, to[1] = (float)v.y, to[2] = (float)v.z;
}

/* Raw directions of forward component 1: GL's pixel (0, 0) is the lower left corner. */
static void put_camera(effects_block *block, const mns_plan *plan, const double jitter[2])
{
    const view_frame *f = &plan->frame;
    double unit = 2 * f->tan_half / f->height;
    vec3 corner = vec3_along(f->forward, unit * (jitter[0] - 0.5 * f->width), f->right);
    vec3_store(block->corner, vec3_along(corner, unit * (jitter[1] - 0.5 * f->height), f->up));
    vec3_store(block->step_x, vec3_scale(f->right, unit));
    vec3_store(block->step_y, vec3_scale(f->up, unit));
    vec3_store(block->eye, vec3_sub(f->eye, vec3_load(plan->tree_origin)));
    block->eye[3] = plan->plane_depth;
    block->corner[3] = vec3_length(vec3_sub(vec3_load(plan->origin), vec3_load(plan->tree_origin)));
    block->size[0] = f->width, block->size[1] = f->height;
}

/* Which side of the surface the eye is on, where solids are seen that cannot tell. */
static int side_of_eye(const mns_plan *plan)
{
    return plan->features & FEATURE_EYE_INSIDE ? 1 : plan->features & FEATURE_EYE_ON ? 2 : 0;
}

static void fill(effects_block *block, const shade_effects *effects, const mns_plan *plan,
                 const double jitter[2], int sample)
{
    const mns_effects *e = &plan->look.effects;
    memset(block, 0, sizeof *block);
    put_camera(block, plan, jitter);
    const double optics[4] = {e->mirror, e->index, e->transmission, e->occlusion_reach};
    memcpy(block->optics, optics, sizeof optics);
    for (size_t i = 0; i < plan->look.light_count; i++) put_light(block, i, plan);
    environment around = environment_of(plan);
    put_axis(block->right, around.right);
    put_axis(block->up, around.up);
    put_axis(block->back, around.back);
    for (int c = 0; c < 3; c++) block->absorption[c] = (float)fmin(e->absorption[c], MOST);
    block->counts[0] = (int32_t)plan->look.light_count;
    block->counts[2] = e->shadow_samples, block->counts[3] = e->occlusion_rays;
    block->levels[0] = (uint32_t)e->reflections, block->levels[1] = (uint32_t)e->refractions;
    block->size[2] = side_of_eye(plan), block->size[3] = 2;
    if (plan->features & FEATURE_SOLIDS) memcpy(block->solids, effects->solids.place, sizeof block->solids);
    block->levels[2] = e->seed, block->levels[3] = (uint32_t)sample;
}

static void keep_loose(shade_loose *loose, const effects_block *block)
{
    const double *wide[LOOSE_DOUBLES] = {block->corner, block->step_x, block->step_y,
                                         block->eye,    block->optics, block->place[0]};
    const float *narrow[LOOSE_FLOATS] = {block->radiance[0], block->right, block->up, block->back,
                                         block->absorption};
    for (int i = 0; i < LOOSE_DOUBLES; i++) memcpy(loose->wide[i], wide[i], sizeof loose->wide[i]);
    for (int i = 0; i < LOOSE_FLOATS; i++) memcpy(loose->narrow[i], narrow[i], sizeof loose->narrow[i]);
    memcpy(loose->counts, block->counts, sizeof block->counts);
    memcpy(loose->levels, block->levels, sizeof block->levels);
    memcpy(loose->size, block->size, sizeof block->size);
    memcpy(loose->solids, block->solids, sizeof block->solids);
}

mns_status shade_effects_send(shade_effects *e, gl_device *device, const mns_plan *plan,
                              const double jitter[2], int sample, mns_error *error)
{
    const GladGLContext *gl = &device->gl;
    effects_block block;
    fill(&block, e, plan, jitter, sample);
    mns_status status = gl_buffer_reserve(device, &e->block, "lights", sizeof block, 0, error);
    if (status) return status;
    gl->BindBuffer(GL_UNIFORM_BUFFER, e->block.id);
    gl->BufferSubData(GL_UNIFORM_BUFFER, 0, sizeof block, &block);
    keep_loose(&e->loose, &block);
    return MNS_OK;
}

/* What glsl/paths_block.glsl has as uniforms of their own (PATHS_LOOSE), to the program in use. */
static void send_loose(const gl_device *device, const shade_loose *loose)
{
    enum { UNIFORM_PATHS = 24 };
    const GladGLContext *gl = &device->gl;
    GLint at = UNIFORM_PATHS;
    for (int i = 0; i < LOOSE_DOUBLES; i++) gl->Uniform4dv(at++, 1, loose->wide[i]);
    for (int i = 0; i < LOOSE_FLOATS; i++) gl->Uniform4fv(at++, 1, loose->narrow[i]);
    gl->Uniform4iv(at++, 1, loose->counts);
    gl->Uniform4uiv(at++, 1, loose->levels);
    gl->Uniform4iv(at++, 1, loose->size);
    if (loose->solids[3]) gl->Uniform4uiv(at, 1, loose->solids);
}

/* ---- The environment's map ---- */

static bool same_map(const shade_effects *e, const char *name, const struct stat *file)
{
    return e->map && !strcmp(e->map_name, name) && e->map_size == file->st_size &&
           e->map_time.tv_sec == file->st_mtim.tv_sec && e->map_time.tv_nsec == file->st_mtim.tv_nsec;
}

static void drop_map(shade_effects *e, gl_device *device)
{
    device->gl.DeleteTextures(1, &e->map);
    free(e->map_name);
    e->map = 0;
    e->map_name = NULL;
}

static void map_texture(shade_effects *e, gl_device *device, const image_picture *picture)
{
    enum { UNPACK = 5 };
    static const GLenum name[UNPACK] = {GL_UNPACK_ALIGNMENT, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS,
                                        GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SWAP_BYTES};
    static const GLint plain[UNPACK] = {4, 0, 0, 0, 0};
    const GladGLContext *gl = &device->gl;
    GLint before[UNPACK];
    for (int i = 0; i < UNPACK; i++) {
        gl->GetIntegerv(name[i], &before[i]);
        gl->PixelStorei(name[i], plain[i]);
    }
    gl->GenTextures(1, &e->map);
    gl->BindTexture(GL_TEXTURE_2D, e->map);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, picture->width, picture->height, 0, GL_RGB, GL_FLOAT,
                   picture->rgb);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl->BindTexture(GL_TEXTURE_2D, 0);
    for (int i = 0; i < UNPACK; i++) gl->PixelStorei(name[i], before[i]);
}

mns_status shade_effects_map(shade_effects *e, gl_device *device, const mns_plan *plan, mns_error *error)
{
    struct stat file = {0};
    environment around;
    if (!(plan->features & FEATURE_ENVIRONMENT)) return MNS_OK;
    bool known = stat(plan->environment, &file) == 0; /* where it is not, reading says why */
    if (known && same_map(e, plan->environment, &file)) return MNS_OK;
    drop_map(e, device);
    mns_status status = environment_begin(&around, plan, error);
    if (status) return status;
    int most = plan->limits.max_texture_size;
    if (around.map.width > most || around.map.height > most) {
        status = status_fail(error, MNS_ERROR_UNSUPPORTED,
                             "%s: %dx%d pixels; this driver's textures have at most %d a side",
                             plan->environment, around.map.width, around.map.height, most);
        goto done;
    }
    map_texture(e, device, &around.map);
    e->map_name = strdup(plan->environment);
    e->map_time = file.st_mtim;
    e->map_size = file.st_size;
    status = e->map_name ? gl_check(device, "environment", error)
                         : status_no_memory(error, "while reading an environment");
    if (status) drop_map(e, device);
done:
    environment_end(&around);
    return status;
}

/* ---- Walks ---- */

static size_t walk_bytes(const mns_plan *plan)
{
    return (size_t)(STORE_WALK + STORE_WAIT * plan_path_stack(plan)) * 4 * sizeof(uint32_t);
}

size_t shade_effects_most(const mns_plan *plan)
{
    size_t room = plan->limits.max_storage_block < STORE_BYTES ? plan->limits.max_storage_block : STORE_BYTES;
    size_t walks = room / walk_bytes(plan);
    size_t listed = (plan->limits.max_storage_block - sizeof(list_counts)) / (LISTS * ENTRY_BYTES);
    return walks < listed ? walks : listed;
}

mns_status shade_effects_reserve(shade_effects *e, list_passes *p, gl_device *device, const mns_plan *plan,
                                 size_t pixels, mns_error *error)
{
    size_t most = plan->limits.max_storage_block;
    if (!(plan->features & FEATURE_RAYS)) return MNS_OK;
    e->room = pixels;
    size_t entries = LISTS * pixels * ENTRY_BYTES;
    return gl_buffer_reserve(device, &p->redo, "list of pixels to resolve", sizeof(list_counts) + entries,
                             most, error);
}

void shade_effects_bind(shade_effects *e, trace_passes *t, list_passes *p, gl_device *device,
                        const mns_plan *plan, const gl_buffer *shading, const shade_planes *planes)
{
    const GladGLContext *gl = &device->gl;
    const GLuint read[] = {planes->t, planes->normal, planes->color, e->map};
    const struct {
        GLuint texture;
        GLenum format;
    } written[] = {{planes->lit, GL_RGBA32F}, {planes->terms, GL_RGBA32F}, {planes->settled, GL_R32F}};
    if (plan->features & FEATURE_RAYS) trace_bind(t, p, device, plan);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, p->redo.id);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, p->view.id);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 1, e->block.id);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 2, shading->id);
    for (GLuint i = 0; i < sizeof read / sizeof *read; i++) {
        gl->ActiveTexture(GL_TEXTURE6 + i);
        gl->BindTexture(GL_TEXTURE_2D, read[i]);
    }
    if (plan->features & FEATURE_SOLIDS) shade_solids_bind(&e->solids, device, planes->mesh);
    for (GLuint i = 0; i < sizeof written / sizeof *written; i++)
        gl->BindImageTexture(1 + i, written[i].texture, 0, GL_FALSE, 0, GL_WRITE_ONLY, written[i].format);
    gl->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

static void clear(list_passes *p, gl_device *device, const list_counts *counts)
{
    const GladGLContext *gl = &device->gl;
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, p->redo.id);
    gl->BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof *counts, counts);
}

void shade_effects_clear(gl_device *device, const mns_plan *plan, GLuint target)
{
    static const float nothing[] = {1, 1, INFINITY, INFINITY}, settled[] = {1, 0, 0, 0};
    const GladGLContext *gl = &device->gl;
    const double *background = plan->look.background;
    float lit[4] = {0, 0, 0, (float)background[3]};
    for (int c = 0; c < 3; c++) lit[c] = shade_linear(background[c]) * lit[3];
    gl->BindFramebuffer(GL_FRAMEBUFFER, target);
    gl->Disable(GL_SCISSOR_TEST);
    gl->ClearBufferfv(GL_COLOR, 0, lit);
    gl->ClearBufferfv(GL_COLOR, 1, nothing);
    gl->ClearBufferfv(GL_COLOR, 2, settled);
    gl->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT); /* walks store into them next */
}

/* One invocation for each of `count`, in groups of which GL promises so many a side. */
static void dispatch(gl_device *device, size_t count)
{
    const GLuint most = 65535, groups = (GLuint)((count + GROUP - 1) / GROUP);
    device->gl.DispatchCompute(groups < most ? groups : most, (groups + most - 1) / most, 1);
}

/* Room for those walks alone that see a surface. */
static mns_status keep_walks(shade_effects *e, gl_device *device, const mns_plan *plan, size_t walks,
                             mns_error *error)
{
    mns_status status = gl_buffer_reserve(device, &e->store, "light's ways", walks * walk_bytes(plan),
                                          plan->limits.max_storage_block, error);
    if (!status) device->gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_STORE, e->store.id);
    return status;
}

mns_status shade_effects_begin(shade_effects *e, list_passes *p, gl_device *device, const mns_plan *plan,
                               const GLuint program[SHADER_COUNT], list_region region, shade_walks *walks,
                               mns_error *error)
{
    const GladGLContext *gl = &device->gl;
    const list_counts none = {0};
    list_counts counts;
    *walks = (shade_walks){0};
    clear(p, device, &none);
    gl->UseProgram(program[SHADER_EFFECTS_LIST]);
    gl->Uniform4i(UNIFORM_REGION, region.x, region.y, region.x + region.width, region.y + region.height);
    const int wide = 8 * BLOCK_WIDTH, high = 8 * BLOCK_HEIGHT; /* pixels a group */
    gl->DispatchCompute((GLuint)((region.width + wide - 1) / wide),
                        (GLuint)((region.height + high - 1) / high), 1);
    trace_finish(p, device, &counts);
    walks->waiting = counts.redo;
    if (!counts.redo) return MNS_OK;
    if (program[SHADER_EFFECTS]) return keep_walks(e, device, plan, counts.redo, error);
    gl->UseProgram(program[SHADER_EFFECTS_PLAIN]);
    dispatch(device, counts.redo);
    trace_finish(p, device, &counts);
    walks->waiting = 0;
    return MNS_OK;
}

/* Bounds and casts take turns; what comes from doubles is tried by bounds first. */
static plan_shader turn(const GLuint program[SHADER_COUNT], shade_walks *walks)
{
    if (!walks->waiting) {
        walks->cast = false;
        return SHADER_EFFECTS_RESOLVE;
    }
    bool any = program[SHADER_EFFECTS_ANY] && !walks->cast;
    walks->cast = any;
    return any ? SHADER_EFFECTS_ANY : SHADER_EFFECTS;
}

void shade_effects_go_on(shade_effects *e, trace_passes *t, list_passes *p, gl_device *device,
                         const GLuint program[SHADER_COUNT], shade_walks *walks)
{
    const GladGLContext *gl = &device->gl;
    plan_shader shader = turn(program, walks);
    bool wide = shader == SHADER_EFFECTS_RESOLVE;
    /* Each of the two lists is read by one dispatch and written anew, into its other half, by the same. */
    size_t *half = &walks->half[wide], count = wide ? walks->waiting_wide : walks->waiting;
    size_t from = (2 * wide + *half) * e->room;
    *half = 1 - *half;
    size_t to = walks->half[0] * e->room, to_wide = (2 + walks->half[1]) * e->room;
    list_counts counts = {.steps = wide ? (GLuint)walks->waiting : 0,
                          .undecided_float = wide ? 0 : (GLuint)walks->waiting_wide};
    clear(p, device, &counts);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, wide ? p->view_wide.id : p->view.id);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, t->balls.id);
    if (wide) gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, t->balls_low.id);
    trace_use(t, device, program[shader]);
    if (!wide) {
        list_view_loose(device, p->view_now);
        send_loose(device, &e->loose);
    }
    gl->Uniform4ui(UNIFORM_LISTS, (GLuint)from, (GLuint)to, (GLuint)to_wide, (GLuint)count);
    dispatch(device, count);
    trace_finish(p, device, &counts);
    walks->waiting = counts.steps;
    walks->waiting_wide = counts.undecided_float;
    walks->rays += counts.spare;
    walks->undecided += counts.undecided;
}

void shade_effects_free(shade_effects *e, gl_device *device)
{
    gl_buffer_free(device, &e->block);
    gl_buffer_free(device, &e->store);
    drop_map(e, device);
    shade_solids_free(&e->solids, device);
    *e = (shade_effects){0};
}
