#include "scene/scene_object.h"

#include "base/status.h"

#include <stdio.h>
#include <string.h>

static mns_status unknown_key(scene_reader *r, const char *key, const scene_key *keys, size_t count)
{
    char known[200] = "";
    for (size_t i = 0, used = 0; i < count && used < sizeof known; i++)
        used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", keys[i].name);
    return status_fail(r->error, MNS_ERROR_INPUT, "%s: %s: unknown key; known: %s", r->path, key, known);
}

mns_status scene_read_object(scene_reader *r, const char *key, const json_t *value, const scene_key *keys,
                             size_t count, void *base)
{
    if (!json_is_object(value)) return scene_wrong(r, key, value, "an object");
    const char *name;
    json_t *member;
    json_object_foreach((json_t *)value, name, member)
    {
        char path[SCENE_PATH_SIZE];
        snprintf(path, sizeof path, "%.30s%s%.80s", key, *key ? "." : "", name);
        const scene_key *found = NULL;
        for (size_t i = 0; i < count && !found; i++)
            if (strcmp(keys[i].name, name) == 0) found = &keys[i];
        if (!found) return unknown_key(r, path, keys, count);
        mns_status status = found->read(r, path, member, (char *)base + found->target);
        if (status) return status;
        if (found->set_bit) *(unsigned *)((char *)base + found->set_target) |= found->set_bit;
    }
    return MNS_OK;
}
