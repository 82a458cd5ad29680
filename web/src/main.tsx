// SPDX-License-Identifier: Apache-2.0
import '@fontsource/atkinson-hyperlegible/latin-400.css';
import '@fontsource/atkinson-hyperlegible/latin-700.css';
import '@fontsource/atkinson-hyperlegible/latin-ext-400.css';
import '@fontsource/atkinson-hyperlegible/latin-ext-700.css';
import { render } from 'preact';
import { startServerConnection } from './api/server';
import { App } from './app';
import './styles/tokens.css';
import './styles/base.css';
import './styles/parts.css';
import './styles/choices.css';
import './styles/shell.css';
import './styles/go.css';
import './styles/map.css';
import './styles/evidence.css';
import './styles/similarity.css';
import './styles/pages.css';
import './styles/explore.css';
import './styles/floor_plan.css';

startServerConnection();
const root = document.getElementById('app');
if (root) render(<App />, root);
