// Looks at a comparison's page as a browser shows it: check.mjs CHROMIUM FOLDER with|without
// FOLDER holds index.html and results.json, maybe results.csv and suite.html; the last word is whether there are charts.
// Leaves screenshots in FOLDER. Exit status 1: something is not as it should be.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Browser } from './browser.mjs';

const [program, folder, charts] = process.argv.slice(2);
const results = JSON.parse(readFileSync(join(folder, 'results.json'), 'utf8'));
const TIME_LIMIT_MS = 240_000;
const SIZE = { width: 1280, height: 800 };
const drawn = results.runs.filter((run) => run.errors);
const isTimed = drawn.some((run) => run.ms.median > 0); // of saved images no run is

const valueOf = (errors, key) => key.split('.').reduce((part, name) => part?.[name], errors);

/* What the chart must hold of one figure, from results.json alone. */
function expectedPoints(key) {
    return drawn.filter((run) => typeof valueOf(run.errors, key) === 'number')
        .map((run) => [run.name, run.ms.median, valueOf(run.errors, key)]);
}

const byName = (points) => points.sort((a, b) => (a[0] < b[0] ? -1 : 1));

/* [name, time, error, height drawn] of every point, read back from the chart itself. */
const chartPoints = () => meniscus.errorChart.data.datasets.filter((set) => !set.isFront)
    .flatMap((set) => set.data.map(({ run, x, error, y }) => [run.name, x, error, y]));

async function checkChart(tab) {
    for (const key of ['t.p99', 't.max', 'residual.median', 'normal.rms', 'missed', 'invented_decided', 'undecided']) {
        const expected = byName(expectedPoints(key));
        if (!expected.length) continue;
        assert.equal(await tab.choose('#figure', key), key, 'the menu offers the figure');
        const points = byName(await tab.run(chartPoints));
        assert.deepEqual(points.map((point) => point.slice(0, 3)), expected, `the chart holds exactly the points of ${key}`);
        const positive = points.filter((point) => point[2] > 0), zero = points.filter((point) => point[2] === 0);
        for (const point of positive) assert.equal(point[3], point[2], 'a value is drawn where it is');
        const lowest = Math.min(...positive.map((point) => point[3]));
        for (const point of zero) assert.ok(point[3] > 0 && point[3] < lowest, 'a zero stands on a floor below every value');
        const scale = await tab.run(() => ({ low: meniscus.errorChart.scales.y.min, kind: meniscus.errorChart.scales.y.type }));
        assert.equal(scale.kind, 'logarithmic');
        for (const point of points) assert.ok(point[3] > scale.low, 'every point lies inside the axes');
    }
    await tab.choose('#figure', 't.p99');
    await checkFront(tab);
    await checkPhases(tab);
    await checkHover(tab);
}

async function checkNoTimes(tab) {
    assert.ok(await tab.run(() => document.getElementById('errors').hidden && document.getElementById('phases').hidden),
        'without times there is no chart of them');
}

async function checkFront(tab) {
    const points = expectedPoints('t.p99');
    const beaten = ([, time, error]) => points.some(([, t, e]) => t <= time && e <= error && (t < time || e < error));
    const expected = points.filter((point) => !beaten(point)).map(([name]) => name).sort();
    assert.deepEqual((await tab.run(() => meniscus.front.map((point) => point.run.name))).sort(), expected, 'the Pareto front');
}

async function checkPhases(tab) {
    const phased = drawn.filter((run) => Object.keys(run.ms.phases).length);
    if (!phased.length) return;
    const sets = await tab.run(() => meniscus.phaseChart.data.datasets.map(({ label, data }) => [label, data]));
    const names = new Set(phased.flatMap((run) => Object.entries(run.ms.phases)).filter(([name, ms]) => ms > 0 && name !== 'total').map(([name]) => name));
    assert.deepEqual(new Set(sets.map(([name]) => name)), names);
    for (const [name, data] of sets) assert.deepEqual(data, phased.map((run) => run.ms.phases[name] ?? 0), `the bars of ${name}`);
}

async function checkHover(tab) {
    const box = await tab.box('#error-chart');
    const [at, name] = await tab.run(() => {
        const chart = meniscus.errorChart, set = chart.data.datasets.findIndex((one) => one.data[0].run?.settings && Object.keys(one.data[0].run.settings).length);
        const index = Math.max(set, 0), { x, y } = chart.getDatasetMeta(index).data[0];
        return [{ x, y }, chart.data.datasets[index].data[0].run.name];
    });
    await tab.mouse('mouseMoved', box.left + at.x - 30, box.top + at.y, 0);
    await tab.mouse('mouseMoved', box.left + at.x, box.top + at.y, 0);
    await tab.settle();
    const told = await tab.run(() => [meniscus.errorChart.tooltip.opacity, meniscus.errorChart.tooltip.title, meniscus.errorChart.tooltip.body.flatMap((part) => part.lines)]);
    assert.ok(told[0] > 0, 'the hover shows');
    assert.ok(told[1].includes(name), 'the hover names the run');
    const run = drawn.find((one) => one.name === name), text = told[2].join('\n');
    for (const [key, value] of Object.entries(run.settings)) assert.ok(text.includes(`${key}=${value}`), 'the hover tells the settings');
    assert.match(text, /time: .* ms/);
}

async function checkWithoutCharts(tab) {
    assert.equal(await tab.run(() => typeof Chart), 'undefined');
    assert.ok(await tab.run(() => !document.getElementById('no-charts').hidden && document.getElementById('no-charts').innerText.includes('chart.js')),
        'the page says which package is missing');
}

async function checkTables(tab) {
    const rows = () => tab.run(() => [...document.querySelectorAll('#figure-table tbody tr')].map((row) => row.firstChild.firstChild.textContent));
    assert.deepEqual(await rows(), results.runs.map((run) => run.name), 'a row a run, its name as it is');
    await tab.click('#figure-table thead th:nth-child(2) button');
    assert.deepEqual((await rows()).slice(0, drawn.length), [...drawn].sort((a, b) => a.ms.median - b.ms.median).map((run) => run.name), 'a heading sorts');
    const last = () => tab.run(() => document.querySelector('#figure-table tbody td:last-child').textContent);
    const before = await last();
    await tab.choose('#measure', 'normal');
    assert.notEqual(await last(), before, 'the menu of columns works');
    for (const run of results.runs.filter((one) => one.failed)) {
        assert.ok(await tab.run((reason) => document.getElementById('figure-table').innerText.includes(reason), run.failed), 'a refused run says why');
    }
}

const clip = (tab) => tab.run(() => Number(/inset\(0px 0px 0px ([\d.]+)%\)/.exec(getComputedStyle(document.getElementById('pane-right')).clipPath)[1]));
const near = (value, wanted, what) => assert.ok(Math.abs(value - wanted) < 0.6, `${what}: ${value}, not ${wanted}`);

async function checkSlider(tab) {
    assert.equal(await tab.run(() => [...document.querySelectorAll('#stage img')].every((image) => image.complete && image.naturalWidth > 0)), true, 'both pictures show');
    near(await clip(tab), 50, 'the divider begins in the middle');
    let box = await tab.box('#stage');
    await tab.drag({ x: box.x, y: box.y }, { x: box.left + 0.2 * box.width, y: box.y });
    near(await clip(tab), 20, 'the divider follows the pointer');
    await tab.mouse('mouseMoved', box.left + 0.7 * box.width, box.y, 0);
    near(await clip(tab), 20, 'let go, it stays');
    const divider = await tab.box('#divider');
    near((100 * (divider.x - box.left)) / box.width, 20, 'the divider stands where the picture is cut');
    await tab.run(() => document.getElementById('divider').focus());
    for (const [key, wanted] of [['ArrowRight', 21], ['ArrowLeft', 20], ['PageUp', 30], ['Home', 0], ['ArrowLeft', 0], ['End', 100]]) {
        await tab.key(key);
        near(await clip(tab), wanted, key);
    }
    assert.equal(await tab.run(() => document.getElementById('divider').getAttribute('aria-valuenow')), '100');
    await tab.key('PageDown');
    const shown = () => tab.run(() => document.getElementById('image-right').src);
    const before = await shown();
    await tab.choose('#right', await tab.run(() => [...document.getElementById('right').options].at(-1).value));
    assert.notEqual(await shown(), before, 'the menu changes the right picture');
    await tab.choose('#zoom', '4');
    await tab.settle();
    box = await tab.box('#stage');
    const center = () => tab.run(() => meniscus.sliderState.center);
    await tab.drag({ x: box.left + 0.5 * box.width, y: box.y }, { x: box.left + 0.3 * box.width, y: box.y });
    near(100 * (await center())[0], 55, 'zoomed in, the picture moves under the pointer');
    near(await clip(tab), 90, 'and the divider does not');
    await tab.choose('#zoom', '1');
}

async function checkPictures(tab) {
    for (const kind of ['image', 'depth', 'mask']) {
        await tab.click(`#kinds button[data-kind=${kind}]`);
        const names = await tab.run(() => [...document.querySelectorAll('#grid figcaption')].map((caption) => caption.textContent));
        assert.deepEqual(names.filter((name) => name !== 'truth'), drawn.map((run) => run.name), `the grid of kind ${kind}`);
        assert.ok((await tab.run(() => document.getElementById('kind-note').textContent)).length > 10, 'its colours are explained');
    }
    await tab.click('#kinds button[data-kind=image]');
}

async function checkWorst(tab) {
    const worst = drawn.flatMap((run) => run.worst.map((pixel) => `${run.name} ${pixel.x}, ${pixel.y}`)).sort();
    const rows = await tab.run(() => [...document.querySelectorAll('#worst-table tbody tr')].map((row) => `${row.children[0].textContent} ${row.children[1].textContent}`));
    assert.deepEqual(rows.sort(), worst, 'every worst pixel is listed');
    if (!worst.length) return;
    const chosen = drawn.findIndex((run) => run.worst.length > 1);
    await tab.choose('#worst-run', String(drawn.filter((run) => run.worst.length).indexOf(drawn[chosen])));
    await tab.click('#worst-table tbody tr:nth-child(2)');
    const pixel = drawn[chosen].worst[1];
    const state = await tab.run(() => ({
        mark: meniscus.sliderState.mark, zoom: meniscus.sliderState.zoom, alt: document.getElementById('image-right').alt,
        seen: !document.getElementById('mark').hidden, at: document.getElementById('mark').getBoundingClientRect().toJSON(),
        stage: document.getElementById('stage').getBoundingClientRect().toJSON(), center: meniscus.sliderState.center,
    }));
    assert.deepEqual(state.mark, { x: pixel.x, y: pixel.y });
    assert.ok(state.seen && state.zoom > 1 && state.alt === `${drawn[chosen].name}: Images`, 'the pixel is marked in its run');
    const { width, height } = results.view ?? await tab.run(() => {
        const { naturalWidth, naturalHeight } = document.getElementById('image-right');
        return { width: naturalWidth, height: naturalHeight };
    });
    const wanted = [(pixel.x + 0.5) / width, (pixel.y + 0.5) / height].map((at, axis) => 0.5 + (at - state.center[axis]) * state.zoom);
    near((100 * (state.at.x + state.at.width / 2 - state.stage.x)) / state.stage.width, 100 * wanted[0], 'the mark, across');
    near((100 * (state.at.y + state.at.height / 2 - state.stage.y)) / state.stage.height, 100 * wanted[1], 'the mark, down');
}

async function checkSuite(tab) {
    if (!results.suite) return;
    const { cases } = results.suite;
    const rows = await tab.run(() => [...document.querySelectorAll('#suite-table tbody tr')].map((row) => [row.firstChild.innerText, ...[...row.querySelectorAll('td')].map((cell) => cell.className)]));
    assert.equal(rows.length, cases.length);
    rows.forEach(([head, ...states], index) => {
        const one = cases[index];
        assert.ok(head.startsWith(one.name) && head.includes(one.why), 'the reason stands under the name');
        assert.deepEqual(states, one.runs.map((run) => (run.verdict === 'fails' && !one.inside ? 'outside' : run.verdict)), one.name);
    });
    await tab.click('#suite-fails');
    assert.equal(await tab.run(() => document.querySelectorAll('#suite-table tbody tr').length), cases.filter((one) => one.runs.some((run) => run.verdict === 'fails')).length);
    await tab.click('#suite-fails');
}

/* What the chart holds against the rows of results.csv, where there is one. */
async function checkCsv(tab) {
    const path = join(folder, 'results.csv');
    if (!existsSync(path) || charts !== 'with' || !isTimed) return;
    const lines = readFileSync(path, 'utf8').trim().split('\n').map((line) => line.match(/("([^"]|"")*"|[^,]*)(,|$)/g).map((cell) => cell.replace(/,$/, '').replace(/^"|"$/g, '').replaceAll('""', '"')));
    const column = (name) => lines[0].indexOf(name);
    const rows = lines.slice(1).filter((cells) => cells[column('t_p99')] !== '').map((cells) => [cells[column('name')], Number(cells[column('ms_median')]), Number(cells[column('t_p99')])]);
    await tab.choose('#figure', 't.p99');
    assert.deepEqual(byName((await tab.run(chartPoints)).map((point) => point.slice(0, 3))), byName(rows), 'the chart has the points that the CSV has');
}

function checkQuiet(tab) {
    assert.deepEqual(tab.complaints, [], 'the console is silent');
    assert.deepEqual(tab.requests.filter((url) => !url.startsWith('file:') && !url.startsWith('data:')), [], 'no request leaves the page');
    assert.equal(tab.requests.filter((url) => url.startsWith('file:')).length, 1, 'one file is all');
}

async function checkPage(browser) {
    const tab = await browser.open(join(folder, 'index.html'), SIZE);
    await tab.run(() => Promise.all([...document.querySelectorAll('#stage img')].map((image) => image.decode())));
    if (results.input) assert.equal(await tab.run(() => document.querySelector('h1').textContent), results.input.name);
    await tab.picture(join(folder, 'light.png'));
    if (isTimed) await (charts === 'with' ? checkChart(tab) : checkWithoutCharts(tab));
    else await checkNoTimes(tab);
    await checkCsv(tab);
    await checkTables(tab);
    await checkSlider(tab);
    await checkPictures(tab);
    await checkWorst(tab);
    await checkSuite(tab);
    assert.equal(await tab.run(() => document.documentElement.scrollWidth <= innerWidth), true, 'nothing is wider than the window');
    await tab.picture(join(folder, 'used.png'));
    checkQuiet(tab);
}

async function checkOther(browser, name, look, picture) {
    const tab = await browser.open(join(folder, name), { ...SIZE, ...look });
    if (picture) await tab.picture(join(folder, picture));
    checkQuiet(tab);
    return tab;
}

const browser = new Browser(program);
const late = setTimeout(() => browser.fail(new Error('the browser does not answer')), TIME_LIMIT_MS);
try {
    await checkPage(browser);
    await checkOther(browser, 'index.html', { dark: true }, 'dark.png');
    if (existsSync(join(folder, 'suite.html'))) {
        const tab = await checkOther(browser, 'suite.html', {}, 'suite.png');
        const open = await tab.run(() => [...document.querySelectorAll('main > section:not([hidden])')].map((part) => part.id));
        assert.deepEqual(open, ['suite', 'about'], 'a suite alone shows nothing empty');
    }
    console.log(`${join(folder, 'index.html')}: as it should be`);
} catch (error) {
    console.error(error);
    process.exitCode = 1;
} finally {
    clearTimeout(late);
    await browser.close();
}
