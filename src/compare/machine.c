#include "compare/machine.h"

#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

static json_t *processor(void)
{
    char line[256], *name = NULL;
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file && !name && fgets(line, sizeof line, file))
        if (!strncmp(line, "model name", 10) && (name = strchr(line, ':'))) name += 1 + (name[1] == ' ');
    if (file) fclose(file);
    if (!name) return json_null();
    name[strcspn(name, "\n")] = '\0';
    json_t *value = json_string(name);
    return value ? value : json_null();
}

static json_t *positive(long long value)
{
    return value > 0 ? json_integer((json_int_t)value) : json_null();
}

json_t *machine_describe(void)
{
    struct utsname names;
    char system[sizeof names.sysname + sizeof names.release + sizeof names.machine + 3] = "";
    if (uname(&names) == 0)
        snprintf(system, sizeof system, "%s %s %s", names.sysname, names.release, names.machine);
    long long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    return json_pack("{s:o, s:o, s:o, s:o}", "cpu", processor(), "cores",
                     positive(sysconf(_SC_NPROCESSORS_ONLN)), "memory_bytes",
                     pages > 0 ? positive(pages * page) : json_null(), "system",
                     *system ? json_string(system) : json_null());
}
