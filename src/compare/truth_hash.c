/* What a truth hangs on, boiled down: where any of it changes, the cache holds nothing. */
#include "compare/truth.h"

#include "field/field.h" /* the balls themselves, which the public face does not show; data alone */

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* Two lanes of multiply and fold over whole words: against chance, not against malice. */
typedef struct hash_state {
    uint64_t lane[2];
} hash_state;

static hash_state hash_start(void)
{
    return (hash_state){{0x9e3779b97f4a7c15u, 0xc2b2ae3d27d4eb4fu}};
}

static void hash_word(hash_state *h, uint64_t word)
{
    h->lane[0] = (h->lane[0] ^ word) * 0xff51afd7ed558ccdu;
    h->lane[0] ^= h->lane[0] >> 32;
    h->lane[1] = (h->lane[1] + word) * 0x9fb21c651e98df25u;
    h->lane[1] ^= h->lane[1] >> 29;
}

static void hash_double(hash_state *h, double value)
{
    uint64_t word;
    value += 0.0; /* -0 and 0 are one */
    memcpy(&word, &value, sizeof word);
    hash_word(h, word);
}

static void hash_doubles(hash_state *h, const double *value, size_t count)
{
    for (size_t i = 0; i < count; i++) hash_double(h, value[i]);
}

static void hash_text(hash_state *h, const char *text)
{
    size_t length = text ? strlen(text) : 0;
    hash_word(h, text ? length + 1 : 0);
    for (size_t i = 0; i < length; i++) hash_word(h, (unsigned char)text[i]);
}

static void hash_end(hash_state *h, char hash[TRUTH_HASH_SIZE])
{
    hash_word(h, 1);
    hash_word(h, 2);
    snprintf(hash, TRUTH_HASH_SIZE, "%016llx%016llx", (unsigned long long)h->lane[0],
             (unsigned long long)h->lane[1]);
}

static void hash_field(hash_state *h, const mns_field *field)
{
    hash_word(h, field->p.count);
    hash_word(h, field->kernel);
    hash_double(h, field->iso);
    if (field_unit(field) != 1) hash_double(h, field_unit(field));
    for (int axis = 0; axis < 3 && field->p.count; axis++)
        hash_doubles(h, field->p.axis[axis], field->p.count);
    for (size_t i = 0; i < field->p.count; i++) {
        hash_double(h, field_radius(field, i));
        hash_double(h, field_strength(field, i));
    }
}

static void hash_view(hash_state *h, const mns_view *view)
{
    hash_doubles(h, view->eye, 3);
    hash_doubles(h, view->look_at, 3);
    hash_doubles(h, view->up, 3);
    hash_double(h, view->fov);
    hash_word(h, (uint64_t)view->width);
    hash_word(h, (uint64_t)view->height);
}

static void hash_light(hash_state *h, const mns_light *light)
{
    hash_word(h, light->kind);
    hash_doubles(h, light->direction, 3);
    hash_doubles(h, light->position, 3);
    hash_double(h, light->radius);
    hash_doubles(h, light->color, 3);
    hash_double(h, light->strength);
}

/* A file goes by its name, size and time: reading it whole would take longer than drawing. */
static void hash_file(hash_state *h, const char *name)
{
    struct stat about;
    hash_text(h, name);
    if (!name || stat(name, &about)) return;
    hash_word(h, (uint64_t)about.st_size);
    hash_word(h, (uint64_t)about.st_mtim.tv_sec);
    hash_word(h, (uint64_t)about.st_mtim.tv_nsec);
}

static void hash_environment(hash_state *h, const char *name)
{
    if (name && *name && strcmp(name, "sky") != 0)
        hash_file(h, name);
    else
        hash_text(h, name);
}

/* A mesh goes by its triangles, which may stand in other files than that. */
static void hash_mesh(hash_state *h, const mns_mesh *mesh)
{
    mns_mesh_info info;
    if (mesh->file && !mns_mesh_get_info(mesh->file, &info, NULL))
        hash_word(h, info.fingerprint);
    else
        hash_file(h, mesh->file);
    hash_word(h, mesh->has_color);
    hash_doubles(h, mesh->color, 3);
}

static void hash_effects(hash_state *h, const mns_effects *e)
{
    hash_word(h, e->shadows);
    hash_word(h, (uint64_t)e->shadow_samples);
    hash_word(h, (uint64_t)e->reflections);
    hash_word(h, (uint64_t)e->refractions);
    hash_doubles(h, (double[3]){e->mirror, e->index, e->transmission}, 3);
    hash_doubles(h, e->absorption, 3);
    hash_word(h, (uint64_t)e->occlusion_rays);
    hash_double(h, e->occlusion_reach);
    hash_environment(h, e->environment);
    hash_word(h, e->seed);
}

static void hash_column(hash_state *h, const char *name, const mns_field *field)
{
    hash_text(h, name);
    for (size_t i = 0; name && i < field->p.column_count; i++) {
        const particles_column *column = &field->p.column[i];
        if (strcmp(column->name, name)) continue;
        hash_doubles(h, column->value, field->p.count);
        for (size_t k = 0; column->label && k < column->label_count; k++) hash_text(h, column->label[k]);
    }
}

static void hash_blend(hash_state *h, const mns_blend *b, const mns_field *field)
{
    hash_word(h, b->set);
    hash_doubles(h, b->range, 2);
    hash_doubles(h, b->color, 3);
    hash_doubles(h, (double[2]){b->mirror, b->transmission}, 2);
    hash_doubles(h, b->absorption, 3);
    hash_column(h, b->by, field);
}

/* Member by member: what fills the gaps between them is anyone's guess. */
static void hash_look(hash_state *h, const mns_look *look, const mns_field *field)
{
    hash_word(h, look->set);
    hash_word(h, look->light);
    hash_doubles(h, look->light_direction, 3);
    hash_word(h, look->shading);
    hash_word(h, (uint64_t)look->cel_bands);
    hash_doubles(h, look->color, 3);
    hash_doubles(h, look->background, 4);
    hash_doubles(h, (double[4]){look->ambient, look->diffuse, look->specular, look->shininess}, 4);
    hash_doubles(h, look->range, 2);
    hash_word(h, look->color_map);
    hash_text(h, look->preset);
    hash_word(h, look->light_count);
    for (size_t i = 0; look->lights && i < look->light_count; i++) hash_light(h, &look->lights[i]);
    hash_effects(h, &look->effects);
    hash_word(h, look->mesh_count);
    for (size_t i = 0; look->meshes && i < look->mesh_count; i++) hash_mesh(h, &look->meshes[i]);
    hash_column(h, look->color_by, field);
    hash_blend(h, &look->blend, field);
}

void truth_hash_field(const mns_field *field, char hash[TRUTH_HASH_SIZE])
{
    hash_state h = hash_start();
    hash_field(&h, field);
    hash_end(&h, hash);
}

void truth_hash(const mns_field *field, const mns_view *view, const mns_look *look, const char *driver,
                char hash[TRUTH_HASH_SIZE])
{
    hash_state h = hash_start();
    hash_text(&h, MNS_REFERENCE_HASH);
    hash_field(&h, field);
    hash_view(&h, view);
    hash_word(&h, look != NULL);
    if (look) {
        hash_text(&h, MNS_SHADE_HASH);
        hash_text(&h, driver);
        hash_look(&h, look, field);
    }
    hash_end(&h, hash);
}
