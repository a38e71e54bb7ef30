import { defineConfig } from 'vitest/config';

// Where `npm run dev` finds a gateway.
const gateway = process.env['ROIS_URL'] ?? 'http://127.0.0.1:8080';

// For terser, which gives new names to properties where it may: private members are those, and `let` alone is less than `let` and `const`.
const lighter = {
  name: 'lighter',
  renderChunk: (code: string) => code.replace(/(?<=\w\.|^ +(?:(?:static|async|get|set) )*)#(?=[a-z])/gm, 'private_').replace(/^( *)const /gm, '$1let '),
};

export default defineConfig({
  plugins: [lighter],
  // All that it writes is in dist/ and build/; nothing is inlined, since the page's policy forbids it.
  cacheDir: 'build/vite',
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    reportCompressedSize: false,
    // What is below is so for the weight of the page with gzip; docs/console.md says what each brings.
    minify: 'terser',
    terserOptions: { module: true, ecma: 2020, safari10: false, compress: { passes: 2, inline: 1, sequences: false, lhs_constants: false } as object },
  },
  esbuild: { jsx: 'transform', jsxFactory: 'h', jsxFragment: 'Fragment', jsxInject: "import { Fragment, h } from 'preact'" },
  // The shipped scenario is read where it stands, in client-cpp/.
  server: { fs: { allow: ['../..'] }, proxy: { '/rois': { target: gateway, ws: true }, '/metrics': gateway, '/readyz': gateway } },
  test: {
    include: ['tests/**/*.test.{ts,tsx}'],
    environment: 'node',
    testTimeout: 60_000,
    hookTimeout: 60_000,
    fileParallelism: false,
  },
});
