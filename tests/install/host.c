/* The smallest host: a field from the installed library. */
#include <meniscus.h>
#include <stdio.h>

int main(void)
{
    const char *name = "scattered:100";
    mns_input *input = NULL;
    mns_field *field = NULL;
    mns_error error = {0};
    mns_field_info info = {0};
    if (mns_input_open(&name, 1, NULL, &input, &error) || mns_input_read(input, 0, &field, &error)) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    mns_field_get_info(field, &info);
    printf("%zu balls\n", info.count);
    mns_field_destroy(field);
    mns_input_close(input);
    return 0;
}
