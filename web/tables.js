/* The tables: every run's figures, and the suite's verdicts. */
(function (page) {
    const { element } = page;

    /* ---- figures */

    const some = (value) => value > 0 ? 'some' : null;

    /* "12 (11)": all, and those that the truth decides. */
    function both(all, decided) {
        if (!page.isNumber(all)) return '–';
        return page.isNumber(decided) && decided !== all ? [page.count(all), element('span', { class: 'aside' }, ` (${page.count(decided)})`)]
            : page.count(all);
    }

    /* Columns: {text, value(run) for sorting, cell(run), name(run) of a class}. */
    function columnsOf(measure) {
        const count = (text, key, decided) => ({
            text, value: (run) => run.errors?.[key],
            cell: (run) => both(run.errors?.[key], decided && run.errors?.[decided]),
            name: (run) => decided || key === 'wrong_root' ? some(run.errors?.[decided ?? key]) : null,
        });
        return [
            { text: 'ms a frame', value: (run) => run.ms?.median, cell: (run) => [page.number(run.ms?.median),
                run.ms ? element('span', { class: 'why' }, `${page.number(run.ms.min)} to ${page.number(run.ms.max)}`) : null] },
            count('missed', 'missed', 'missed_decided'),
            count('invented', 'invented', 'invented_decided'),
            count('wrong root', 'wrong_root'),
            count('undecided', 'undecided'),
            ...page.terms.map(([key, text]) => ({ ...count(text, key), name: (run) => some(run.errors?.[key]) })),
            { text: 'PSNR, dB', value: (run) => run.errors?.psnr,
                cell: (run) => run.errors?.psnr >= 200 ? 'equal' : page.number(run.errors?.psnr) },
            ...page.parts.map(([part, text]) => ({
                text, value: (run) => run.errors?.[measure]?.[part], cell: (run) => page.number(run.errors?.[measure]?.[part]),
            })),
        ];
    }

    function runName(run) {
        const settings = page.settings(run).split(', ').every((one) => run.name.includes(one)) ? '' : page.settings(run);
        return element('th', { scope: 'row' }, run.name,
            run.pareto ? element('span', { class: 'front', title: 'On the Pareto front of time and the 99th percentile of the distance error' }, '\u00a0◆') : null,
            run.failed ? element('span', { class: 'why' }, String(run.failed)) : settings ? element('span', { class: 'why' }, settings) : null);
    }

    const order = { column: -1, down: false };

    /* What does not exist goes last, whichever way is sorted. */
    function sorted(runs, columns) {
        const column = columns[order.column];
        if (!column) return runs;
        const sign = order.down ? -1 : 1;
        return [...runs].sort((a, b) => {
            const [x, y] = [column.value(a), column.value(b)];
            if (!page.isNumber(x) || !page.isNumber(y)) return page.isNumber(y) - page.isNumber(x);
            return sign * (x - y);
        });
    }

    function drawFigures() {
        const columns = columnsOf(page.byId('measure').value);
        const heads = columns.map(({ text }, index) => element('th', {
            scope: 'col', 'aria-sort': order.column === index ? (order.down ? 'descending' : 'ascending') : null,
        }, element('button', {
            type: 'button',
            onclick() {
                order.down = order.column === index && !order.down;
                order.column = index;
                drawFigures();
            },
        }, text)));
        const rows = sorted(page.runs, columns).map((run) => element('tr', null, runName(run),
            columns.map((column) => element('td', { class: column.name?.(run) }, column.cell(run)))));
        page.byId('figure-table').replaceChildren(
            element('thead', null, element('tr', null, element('th', { scope: 'col' }, 'Run'), heads)),
            element('tbody', null, rows));
    }

    /* ---- the suite */

    const STATES = [['holds', 'holds'], ['fails', 'fails inside its domain'], ['outside', 'outside the stated domain'],
        ['refused', 'refused, with the reason']];

    /* Red is for failures inside the domain alone. */
    const stateOf = (one, verdict) => verdict === 'fails' && one.inside === false ? 'outside' : verdict;

    function cell(one, run) {
        if (!run) return element('td', null, '–');
        const wrong = [['missed', run.missed], ['invented', run.invented]].filter(([, count]) => count > 0)
            .map(([text, count]) => `${page.count(count)} ${text}`);
        if (run.undecided > 0) wrong.push(`${page.count(run.undecided)} undecided`);
        const known = [page.isNumber(run.ms) ? page.ms(run.ms) : null, page.isNumber(run.t_p999) ? `t p99.9 ${page.number(run.t_p999)}` : null]
            .filter(Boolean);
        const small = (text) => text ? element('small', null, text) : null;
        return element('td', { class: stateOf(one, run.verdict), title: page.isNumber(run.pixels) ? `of ${page.plural(run.pixels, 'pixel')}` : null },
            element('b', null, run.verdict), small(wrong.join(', ')), small(known.join(', ')), small(run.note));
    }

    function caseName(one) {
        return element('th', { scope: 'row' }, one.name, element('span', { class: 'why' }, one.why),
            one.inside === false ? element('span', { class: 'why limit' }, `beyond: ${(one.limits ?? []).join(', ') || 'the stated domain'}`) : null);
    }

    /* "12 of 14 hold": of the cases inside the domain. */
    function score(cases, name) {
        const inside = cases.filter((one) => one.inside !== false).map((one) => one.runs.find((run) => run.name === name)).filter(Boolean);
        return `${inside.filter((run) => run.verdict === 'holds').length} of ${inside.length} hold inside the domain`;
    }

    function drawSuite(suite) {
        const onlyFails = page.byId('suite-fails').checked;
        const names = [...new Set(suite.cases.flatMap((one) => one.runs.map((run) => run.name)))];
        const cases = suite.cases.filter((one) => !onlyFails || one.runs.some((run) => run.verdict === 'fails'));
        page.byId('suite-table').replaceChildren(
            element('thead', null, element('tr', null, element('th', { scope: 'col' }, 'Case'),
                names.map((name) => element('th', { scope: 'col' }, name, element('span', { class: 'why' }, score(suite.cases, name)))))),
            element('tbody', null, cases.map((one) => element('tr', null, caseName(one),
                names.map((name) => cell(one, one.runs.find((run) => run.name === name)))))));
    }

    page.startTables = function () {
        if (page.runs.length) {
            page.show('figures');
            const measure = page.byId('measure');
            page.fill(measure, page.spreads.map(([key, text]) => [key, text]));
            measure.addEventListener('change', drawFigures);
            drawFigures();
        }
        const suite = page.results.suite;
        if (!suite?.cases?.length) return;
        page.show('suite');
        page.byId('suite-title').textContent = `The ${suite.name} suite`;
        page.byId('suite-legend').append(...STATES.map(([state, text]) => element('span', { class: state }, text)));
        page.byId('suite-fails').addEventListener('change', () => drawSuite(suite));
        drawSuite(suite);
    };
})(meniscus);
