// SPDX-License-Identifier: Apache-2.0
import preact from '@preact/preset-vite';
import { defineConfig } from 'vitest/config';

const mock = `http://127.0.0.1:${process.env.HOMEWARD_MOCK_PORT ?? '8099'}`;

export default defineConfig({
  plugins: [preact({ prefreshEnabled: true })],
  build: {
    target: 'es2022',
    // The server sends a content security policy without inline code and without data: addresses.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 700,
  },
  server: {
    proxy: { '/api': { target: mock, ws: true }, '/mock': mock },
    fs: { allow: ['.', '../proto'] }, // the catalogues of reasons
  },
  test: { include: ['src/**/*.test.{ts,tsx}', 'dev/*.test.mjs'], environment: 'node' },
});
