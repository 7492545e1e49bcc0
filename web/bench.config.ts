import config from './playwright.config';

/** `make bench-app`: reports, asserts nothing. */
export default { ...config, testDir: 'bench', reporter: 'list' };
