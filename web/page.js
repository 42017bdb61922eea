/* The comparison's page: its data, how numbers are written, and its head and foot. All text goes into the page as
 * text nodes, never as markup: names are a stranger's. */
'use strict';

const meniscus = {
    results: JSON.parse(document.getElementById('results-data').textContent),
    pictures: JSON.parse(document.getElementById('pictures-data').textContent),
};

(function (page) {
    /* element('td', {class: 'fails', onclick: f}, 'text', child, ...): what is null is left out. */
    page.element = function (tag, attributes, ...children) {
        const made = document.createElement(tag);
        for (const [name, value] of Object.entries(attributes ?? {})) {
            if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
            else if (value !== null && value !== undefined && value !== false) made.setAttribute(name, value);
        }
        made.append(...children.flat().filter((child) => child !== null && child !== undefined));
        return made;
    };

    page.byId = (id) => document.getElementById(id);

    /* [[value, text], ...] as the options of a <select>; a group is [text, [[value, text], ...]]. */
    page.fill = function (select, choices) {
        select.replaceChildren(...choices.map(([value, text]) => Array.isArray(text)
            ? page.element('optgroup', { label: value }, text.map(option)) : option([value, text])));
    };

    function option([value, text]) {
        return page.element('option', { value }, text);
    }

    const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);
    page.isNumber = isNumber;

    /* Three digits, short: 0, 12, 1.25, 3.1e-7; "–" for what does not exist. */
    page.number = function (value) {
        if (!isNumber(value)) return '–';
        if (value === 0) return '0';
        const size = Math.abs(value);
        if (size < 1e-3 || size >= 1e6) {
            return value.toExponential(2).replace(/\.?0+e/, 'e').replace('e+', 'e');
        }
        return size >= 100 ? String(Math.round(value)) : String(Number(value.toPrecision(3)));
    };

    page.count = (value) => isNumber(value) ? value.toLocaleString('en-US').replaceAll(',', '\u202f') : '–';
    page.plural = (count, noun) => `${page.count(count)} ${noun}${count === 1 ? '' : 's'}`;
    page.ms = (value) => isNumber(value) ? `${page.number(value)} ms` : '–';

    /* "steps=8, tolerance=1e-4"; "" where there are none. */
    page.settings = (run) => Object.entries(run.settings ?? {}).map(([key, value]) => `${key}=${value}`).join(', ');
    /* What a curve is of. */
    page.curve = (run) => run.solver ? `${run.method} · ${run.solver}` : String(run.method);

    page.runs = page.results.runs ?? [];
    /* Of saved images there are errors, but no times. */
    page.measured = page.runs.filter((run) => run.ms?.median > 0 && run.errors);

    const SPREADS = [
        ['t', 'Distance |t − t*| / max(t*, R)', 'Distance'],
        ['footprint', 'Distance in pixel footprints', 'Footprints'],
        ['residual', 'Residual |f − L| / L', 'Residual'],
        ['normal', 'Normal, degrees', 'Normal'],
    ];
    const PARTS = [['median', 'median'], ['p99', 'p99'], ['p999', 'p99.9'], ['max', 'largest'], ['rms', 'RMS']];
    const COUNTS = [
        ['missed_decided', 'Missed pixels, decided'], ['invented_decided', 'Invented pixels, decided'],
        ['missed', 'Missed pixels, all'], ['invented', 'Invented pixels, all'],
        ['wrong_root', 'Wrong root, pixels'], ['undecided', 'Undecided pixels'],
    ];
    /* Terms of effects, those that some run has. */
    page.terms = ['shadow', 'occlusion', 'mirror', 'refraction'].map((term) => [`${term}_wrong`, `wrong ${term}`])
        .filter(([key]) => page.runs.some((run) => isNumber(run.errors?.[key])));
    page.spreads = SPREADS;
    page.parts = PARTS;

    /* PSNR of equal images is given as 200 dB: no error. */
    const PSNR_EQUAL = 200;
    function imageError(errors) {
        if (!isNumber(errors.psnr)) return null;
        return errors.psnr >= PSNR_EQUAL ? 0 : 10 ** (-errors.psnr / 20);
    }

    /* Every error that can be drawn: {key, group, text (in the menu), title, isCount, of(errors) -> number or null}. */
    page.errorFigures = [
        ...SPREADS.flatMap(([key, group, short]) => PARTS.map(([part, name]) => ({
            key: `${key}.${part}`, group, text: `${short}, ${name}`, title: `${group}, ${name}`, isCount: false,
            of: (errors) => errors[key]?.[part] ?? null,
        }))),
        ...COUNTS.map(([key, text]) => ({
            key, group: 'Pixels', text, title: text, isCount: true, of: (errors) => errors[key] ?? null,
        })),
        { key: 'psnr', group: 'Image', text: 'Image, RMS', title: 'RMS of the image, of full scale (from PSNR)', isCount: false,
            of: imageError },
    ];

    function settle(id, ...text) {
        page.byId(id).replaceChildren(...text);
    }

    function head() {
        const { input, view, runs, suite, truth } = page.results;
        const name = input?.name ?? (suite ? `The ${suite.name} suite` : 'A comparison');
        const parts = [];
        if (isNumber(input?.count)) parts.push(page.plural(input.count, 'ball'));
        if (input?.kernel) parts.push(`kernel ${input.kernel}, level ${page.number(input.iso)}`);
        if (view) parts.push(`${view.width} × ${view.height}`);
        if (runs?.length) parts.push(page.plural(runs.length, 'run'));
        if (truth) parts.push(`the truth hits ${page.plural(truth.hits, 'pixel')} and leaves ${page.count(truth.undecided)} undecided`);
        if (suite?.cases) parts.push(page.plural(suite.cases.length, 'hard case'));
        settle('title', name);
        settle('lead', `${parts.join('; ')}.`);
        document.title = `${name} – Meniscus`;
    }

    function bytes(value) {
        return isNumber(value) ? `${page.number(value / 2 ** 30)} GiB` : null;
    }

    function about() {
        const { command, created, machine, renderer, backend, version, commit, input, view, truth } = page.results;
        const triple = (v) => Array.isArray(v) ? v.map((x) => page.number(x)).join(', ') : null;
        const lines = [
            ['Command', command && page.element('code', null, command)],
            ['When', created],
            ['Machine', machine && [machine.cpu, isNumber(machine.cores) && page.plural(machine.cores, 'core'),
                bytes(machine.memory_bytes), machine.system].filter(Boolean).join('; ')],
            ['Renderer', renderer && [renderer, backend].filter(Boolean).join('; ')],
            ['Version', version && [version, commit && `commit ${commit}`].filter(Boolean).join('; ')],
            ['Input', input && `${input.name}, ${page.count(input.count)} balls, hash ${input.hash}`],
            ['View', view && `eye ${triple(view.eye)}; to ${triple(view.look_at)}; up ${triple(view.up)}; ${page.number(view.fov)}° high`],
            ['Truth', truth && (truth.cached ? `from the cache; tracing it took ${page.ms(truth.ms)}` : `traced in ${page.ms(truth.ms)}`)],
        ];
        page.byId('about-list').replaceChildren(...lines.filter(([, text]) => text).flatMap(([name, text]) =>
            [page.element('dt', null, name), page.element('dd', null, text)]));
    }

    function navigation() {
        const parts = [...document.querySelectorAll('main > section:not([hidden])')];
        page.byId('nav').replaceChildren(...parts.map((part) => page.element('a', { href: `#${part.id}` }, part.dataset.name)));
    }

    page.show = (id) => { page.byId(id).hidden = false; };

    page.start = function () {
        head();
        about();
        page.startCharts();
        page.startTables();
        page.startPictures();
        navigation();
    };
})(meniscus);
