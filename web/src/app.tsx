// SPDX-License-Identifier: Apache-2.0
import type { ComponentType } from 'preact';
import { useEffect } from 'preact/hooks';
import { connection, findOutWho, me, meError, newBuild, now_ms, wantGraph } from './api/server';
import { Brand } from './components/brand';
import { Icon } from './components/icons';
import { Notice, Waiting } from './components/notice';
import { SetUp } from './features/account/set_up';
import { SignIn } from './features/account/sign_in';
import { resumeLeases } from './features/go/driving';
import { GoPage } from './features/go/go_page';
import { keepScreenOn } from './features/go/screen';
import { StopButton } from './features/go/stop_button';
import { MapPage } from './features/map/map_page';
import { RobotsPage } from './features/robots/robots_page';
import { SettingsPage } from './features/settings/settings_page';
import { ToursPage } from './features/tours/tours_page';
import { chosenMap } from './lib/chosen';
import { follow, kViews, path, viewOf, type View } from './lib/router';
import { ageText } from './lib/words';

const kPages: Readonly<Record<View, { title: string; page: ComponentType }>> = {
  go: { title: 'Go', page: GoPage },
  map: { title: 'Map', page: MapPage },
  tours: { title: 'Tours', page: ToursPage },
  robots: { title: 'Robots', page: RobotsPage },
  settings: { title: 'Settings', page: SettingsPage },
};

export function App() {
  useEffect(() => void findOutWho(), []);
  if (path.value.startsWith('/setup')) return <SetUp />;
  if (meError.value) return <Unreachable />;
  if (me.value === undefined)
    return (
      <div class="alone">
        <Waiting what="One moment …" />
      </div>
    );
  return me.value === null ? <SignIn /> : <Shell />;
}

function Unreachable() {
  useEffect(() => {
    const timer = setInterval(() => void findOutWho(), 4000);
    return () => clearInterval(timer);
  }, []);
  return (
    <div class="alone">
      <main>
        <Brand />
        <h1>The house server cannot be reached</h1>
        <Notice tone="bad">
          {meError.value?.message} To stop the chair, use the stop button on the chair itself. This page keeps
          trying.
        </Notice>
        <button type="button" class="button main" onClick={() => void findOutWho()}>
          Try again now
        </button>
      </main>
    </div>
  );
}

function Shell() {
  const view = viewOf(path.value);
  const { title, page: Page } = kPages[view];
  const map = chosenMap.value;
  useEffect(() => void resumeLeases(), []);
  useEffect(keepScreenOn, []);
  useEffect(() => {
    if (map && map.revision > 0) wantGraph(map);
  }, [map]);
  useEffect(() => {
    document.title = `${title} – Homeward`;
  }, [title]);
  return (
    <div class="shell">
      <a class="button skip" href="#content">
        Skip to the content
      </a>
      <header class="rail">
        <Brand />
        <nav class="tabs" aria-label="Pages">
          {kViews.map((one) => (
            <a key={one} href={`/${one}`} aria-current={one === view ? 'page' : undefined} onClick={follow}>
              <Icon name={one} />
              {kPages[one].title}
            </a>
          ))}
        </nav>
        <StopButton />
      </header>
      <div class="content">
        <ConnectionNotice />
        {newBuild.value && (
          <Notice>
            The house server was updated.{' '}
            <button type="button" class="button" onClick={() => location.reload()}>
              Load the page again
            </button>
          </Notice>
        )}
        <main id="content" tabIndex={-1} key={view}>
          <Page />
        </main>
      </div>
    </div>
  );
}

function ConnectionNotice() {
  const { state, last_message_ms } = connection.value;
  if (state !== 'offline') return null;
  return (
    <>
      <Notice tone="bad">
        <strong>The house server cannot be reached.</strong> To stop the chair, use the stop button on the
        chair itself. This page keeps trying.
      </Notice>
      {last_message_ms !== null && (
        <p class="soft offline-age">What you see is {ageText(now_ms.value - last_message_ms)} old.</p>
      )}
    </>
  );
}
